#pragma once

#include <memory>

#include "kinegraph/komo/komo.h"
#include "kinegraph/trajectories/b_spline.h"

namespace kinegraph {

struct SplineMotionOptions {
  int points = 8;            ///< control points after the start, evenly spaced in time; at most one per slice
  int degree = 3;            ///< of the spline, 1 to 9
  bool ends_at_rest = true;  ///< otherwise there are floor(degree / 2) more control points

  void validate(int slices) const;  ///< throws ValueError
};

/// The trajectory optimization problem of a Komo with its slices on a B-spline, whose control points are the variables.
/// They are few even for many slices, the motion is smooth for any objectives, and it can be executed directly.
///
/// All joints of the initial configuration are part of the spline, which starts at rest in the slice before the first.
/// Joint limits are bounds of its control points, so that the spline satisfies them everywhere. With addFreeMotion the
/// spline is continuously collision-free, and reports of collisions refer to the spline. Other variables, such as the
/// dofs of attached objects and dofs that slices share, remain variables; they move linearly between slices.
class SplineMotion {
 public:
  /// Throws ValueError for invalid options.
  explicit SplineMotion(std::shared_ptr<Komo> komo, const SplineMotionOptions& options = {});

  const std::shared_ptr<Komo>& komo() const { return komo_; }
  const SplineMotionOptions& options() const { return options_; }

  /// Returns the problem for a solver, which leaves the Komo's path at its result. It uses the objectives and the start
  /// that the Komo has now, and starts near its present path.
  std::shared_ptr<Nlp> nlp() const;

  /// Returns the spline through the Komo's present path, in s after the start; the best approximation if a solver has
  /// not left the path there.
  BSpline spline() const;

  /// Returns true if all pairs of shapes that joints move relative to each other provably stay `margin` (m) apart along
  /// the spline. May return false for pairs within margin + 3e-5 m. Throws ValueError for a margin that is not finite.
  bool isFree(double margin = 0.) const;

 private:
  std::shared_ptr<Komo> komo_;
  SplineMotionOptions options_;
};

}  // namespace kinegraph
