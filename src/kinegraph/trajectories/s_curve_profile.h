#pragma once

#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph {

/// Largest |s'|, |s''|, |s'''| of a motion along a line.
struct LineMotionLimits {
  double speed, acceleration, jerk;
};

/// Appends the fastest motion along a line from s0 to s1 > s0 between two speeds, with no acceleration at both ends:
/// up to three phases of constant jerk up to a speed, a cruise, and three phases down. False if the way is too short to
/// get from one speed to the other; nothing is appended then.
bool addDoubleS(TimeScaling& scaling, double s0, double s1, double speed0, double speed1,
                const LineMotionLimits& limits, int piece);

}  // namespace kinegraph
