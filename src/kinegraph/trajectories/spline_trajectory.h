#pragma once

#include "kinegraph/trajectories/b_spline.h"
#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph {

/// A B-spline as a Trajectory: t = 0 is the spline's `origin`, and the trajectory ends with the spline.
class SplineTrajectory final : public Trajectory {
 public:
  /// Keeps a copy of the spline; t = 0 is its first knot. Throws ValueError if it has no control points.
  explicit SplineTrajectory(BSpline spline);

  /// The same, with the time of the spline (s) at t = 0. Before its first knot a spline stays at its first control
  /// point. Throws ValueError if the spline ends before `origin`.
  SplineTrajectory(BSpline spline, double origin);

  int dimension() const override { return spline_.dimension(); }
  double duration() const override { return duration_; }

  /// At the end, velocity and acceleration are the left-hand limits; those of the spline itself are zero there.
  void evalTo(double t, double* q, double* velocity, double* acceleration) const override;

  const BSpline& spline() const { return spline_; }

 private:
  BSpline spline_;
  double origin_, duration_;
};

}  // namespace kinegraph
