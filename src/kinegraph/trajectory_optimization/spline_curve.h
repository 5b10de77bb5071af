#pragma once

#include <memory>
#include <vector>

#include "kinegraph/collision/displacement_bound.h"
#include "kinegraph/komo/path/path_motion.h"
#include "kinegraph/trajectory_optimization/spline_layout.h"

namespace kinegraph::inline trajectory_optimization_internal {

/// The motion between slices along the spline of a SplineMotion, with a bound on its distance from chords. It shares no
/// data with the path, which may change. Dofs that are not part of the spline move linearly, as in a SliceMotion. Times
/// are fractions of the motion to a slice, in [0, 1].
class SplineCurve {
 public:
  SplineCurve(const Path& path, std::shared_ptr<const SplineLayout> layout);

  /// The path must be at M c + offset.
  void moveTo(const Path& path, const VectorXd& c);

  const SliceMotion& motionInto(int slice) const { return motions_[std::size_t(slice)]; }

  VectorXd at(int slice, double time) const;

  /// Returns the chord between two times.
  SliceMotion line(int slice, double begin, double end) const;

  /// Returns 0, the times of the knots inside of the motion, and 1. Between consecutive ones the spline is one
  /// polynomial.
  const std::vector<double>& knotsOn(int slice) const { return knots_on_[std::size_t(slice)]; }

  /// Returns a bound on how much closer two shapes may be on the spline than on a chord, m. Between consecutive
  /// knotsOn, h apart, the spline deviates from its chord by at most h^2 / 8 max |q''|, and |q''| is at most that of
  /// the control points of q'' that influence the interval.
  double deviation(const SliceMotion& line, double begin, double end);

 private:
  void boundSecondDerivatives();
  int pieceAt(double time) const;

  std::shared_ptr<const SplineLayout> layout_;
  double tau_;
  std::vector<std::vector<double>> knots_on_;  ///< per slice
  std::vector<std::vector<int>> dofs_;         ///< per slice and splined dof: index in the previous slice
  std::vector<double> knots_;                  ///< distinct ones, s
  BSpline spline_;
  std::vector<SliceMotion> motions_;
  MatrixXd second_derivatives_;  ///< per polynomial and splined dof: bound on |q''|
  std::vector<DeviationBound> bounds_;
  std::vector<int> bound_of_;  ///< per slice
};

}  // namespace kinegraph::inline trajectory_optimization_internal
