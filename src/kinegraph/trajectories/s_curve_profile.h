#pragma once

#include "kinegraph/trajectories/scaling_grid.h"
#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph::inline trajectories_internal {

/// Limits of |s'|, |s''|, |s'''| for a motion along a line.
struct LineMotionLimits {
  double speed, acceleration, jerk;
};

/// Returns the limits of |s'|, |s''|, |s'''| for a motion along a tangent, one number per dof; 1e15 for none.
LineMotionLimits limitsAlong(const double* tangent, const MotionLimits& limits);

/// Appends the fastest S-curve profile from s0 to s1 > s0 between two speeds, with zero acceleration at both ends: up
/// to three phases of constant jerk, a cruise, and three more phases. Returns false, and appends nothing, if the
/// distance is too short for the change of speed.
bool addSCurve(TimeScaling& scaling, double s0, double s1, double speed0, double speed1, const LineMotionLimits& limits,
               int piece);

}  // namespace kinegraph::inline trajectories_internal
