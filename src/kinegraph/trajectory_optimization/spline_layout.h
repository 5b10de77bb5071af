#pragma once

#include <memory>
#include <vector>

#include "kinegraph/komo/path/path.h"
#include "kinegraph/nlp/mapped_nlp.h"
#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph {
struct SplineMotionOptions;
}

namespace kinegraph::inline trajectory_optimization_internal {

/// The layout of the variables c of a SplineMotion; x = M c + offset are those of the path.
struct SplineLayout {
  std::shared_ptr<LinearMap> map;
  VectorXd lower, upper;     ///< of c
  std::vector<int> splined;  ///< those of the initial configuration's dofs that are part of the spline
  Eigen::MatrixXi columns;   ///< of c: (control point after the start, splined dof)
  VectorXd start;            ///< of the splined dofs
  BSpline knots;             ///< without control points
  bool ends_at_rest = true;

  MatrixXd pointsOf(const VectorXd& c) const;  ///< control points in rows, beginning with the start
  BSpline splineOf(const VectorXd& c) const;   ///< of the splined dofs, in s
  VectorXd weightsAt(double time) const;       ///< of the control points, beginning with the start; time in s
};

/// Returns the entry of x of a dof of a slice; -1 if there is none.
int columnOf(const Path& path, int slice, int dof);

/// Returns the weights of the control points, beginning with the start, in the slices: slices x control points.
MatrixXd splineBasis(const TimeGrid& grid, const SplineMotionOptions& options);

SplineLayout layOutSpline(const Path& path, const SplineMotionOptions& options);

}  // namespace kinegraph::inline trajectory_optimization_internal
