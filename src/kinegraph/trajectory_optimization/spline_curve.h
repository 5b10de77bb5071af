#pragma once

#include <memory>
#include <vector>

#include "kinegraph/collision/displacement_bound.h"
#include "kinegraph/komo/path/path_motion.h"
#include "kinegraph/trajectory_optimization/spline_layout.h"

namespace kinegraph {

/// How q goes from slice to slice on the spline of a SplineMotion, and how far from straight. It shares nothing with the
/// path, which may change. Dofs that the spline does not take go straight, as in a SliceMotion. Times are shares of the way to
/// a slice, in [0, 1].
class SplineCurve {
 public:
  SplineCurve(const Path& path, std::shared_ptr<const SplineLayout> layout);

  /// The path is at M c + offset.
  void moveTo(const Path& path, const VectorXd& c);

  const SliceMotion& motionInto(int slice) const { return motions_[std::size_t(slice)]; }

  VectorXd at(int slice, double share) const;

  /// The straight line between two times.
  SliceMotion line(int slice, double begin, double end) const;

  /// 0, the times of the knots on the way, and 1: between two of them the spline is one polynomial.
  const std::vector<double>& knotsOn(int slice) const { return knots_on_[std::size_t(slice)]; }

  /// By how much two shapes may be nearer to each other than where q is on a line, at most, m. Between two neighbors of
  /// knotsOn, h apart, the spline leaves its chord by at most h^2 / 8 max |q''|, and |q''| is at most that of the control
  /// points of q'' that count there.
  double stray(const SliceMotion& line, double begin, double end);

 private:
  void boundBends();
  int pieceAt(double time) const;

  std::shared_ptr<const SplineLayout> layout_;
  double tau_;
  std::vector<std::vector<double>> knots_on_;  ///< per slice
  std::vector<std::vector<int>> dofs_;         ///< per slice, per splined dof: of the slice before
  std::vector<double> knots_;                  ///< different ones, s
  BSpline spline_;
  std::vector<SliceMotion> motions_;
  MatrixXd bends_;  ///< per polynomial and splined dof: |q''|, at most
  std::vector<DeviationBound> bounds_;
  std::vector<int> bound_of_;  ///< per slice
};

}  // namespace kinegraph
