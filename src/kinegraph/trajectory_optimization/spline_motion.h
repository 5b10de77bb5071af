#pragma once

#include <memory>

#include "kinegraph/komo/komo.h"
#include "kinegraph/trajectories/b_spline.h"

namespace kinegraph {

struct SplineMotionOptions {
  int points = 8;            ///< control points behind the start, equally far apart in time; at most one per slice
  int degree = 3;            ///< of the spline, 1 to 9
  bool ends_at_rest = true;  ///< else there are floor(degree / 2) control points more

  void validate(int slices) const;  ///< throws ValueError
};

/// The motion problem of a Komo, whose slices lie on a B-spline: its variables are control points. There are few of them
/// for many slices, the motion is smooth whatever the objectives are, and it can be executed as it is.
///
/// The spline takes all joints of the given configuration, begins in the slice before the first and is there at rest.
/// Limits of joints are bounds of its control points, so that it keeps them at all times. Where its motion is to be free at
/// all times (addFreeMotion) the spline is, and what results say of that (free) is said of the spline. Other variables, as
/// of objects that are held, and what all slices share, stay as they are; between slices they go straight.
class SplineMotion {
 public:
  /// Throws ValueError for options that do not fit.
  explicit SplineMotion(std::shared_ptr<Komo> komo, const SplineMotionOptions& options = {});

  const std::shared_ptr<Komo>& komo() const { return komo_; }
  const SplineMotionOptions& options() const { return options_; }

  /// The problem for a solver, which leaves the Komo's path at its result; with the objectives and the start that the
  /// Komo has now. Solvers begin near to its present path.
  std::shared_ptr<Nlp> nlp() const;

  /// The spline through the Komo's present path, in s from the start on; the nearest one, where a solver has not left it.
  BSpline spline() const;

  /// Do all pairs of shapes that joints move apart keep `margin` (m) on that spline, at all times? True only where that is
  /// proved; of pairs within margin + 3e-5 m it may say no. Throws ValueError for a margin that is not finite.
  bool isFree(double margin = 0.) const;

 private:
  std::shared_ptr<Komo> komo_;
  SplineMotionOptions options_;
};

}  // namespace kinegraph
