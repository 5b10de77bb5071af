#pragma once

#include <memory>
#include <vector>

#include "kinegraph/komo/path/path.h"
#include "kinegraph/nlp/mapped_nlp.h"
#include "kinegraph/trajectories/b_spline.h"

namespace kinegraph {

struct SplineMotionOptions;

/// Where what a SplineMotion consists of is among its variables c; x = M c + offset are those of the path.
struct SplineLayout {
  std::shared_ptr<LinearMap> map;
  VectorXd lower, upper;     ///< of c
  std::vector<int> splined;  ///< of the given configuration's dofs: those that the spline takes
  Eigen::MatrixXi columns;   ///< of c: (control point behind the start, splined dof)
  VectorXd start;            ///< of the splined dofs
  BSpline knots;             ///< without control points
  bool ends_at_rest = true;

  MatrixXd pointsOf(const VectorXd& c) const;  ///< control points, the start first: one row each
  BSpline splineOf(const VectorXd& c) const;   ///< of the splined dofs, in s
  VectorXd weightsAt(double time) const;       ///< of the control points, the start first; time in s
};

/// Which entry of x a dof of a slice is; -1: none.
int columnOf(const Path& path, int slice, int dof);

/// How much each control point, the start first, counts in the slices: slices x control points.
MatrixXd splineBasis(const TimeGrid& grid, const SplineMotionOptions& options);

SplineLayout layOutSpline(const Path& path, const SplineMotionOptions& options);

}  // namespace kinegraph
