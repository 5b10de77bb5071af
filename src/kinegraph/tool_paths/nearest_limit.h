#pragma once

#include <string>

#include "kinegraph/trajectories/retime.h"

namespace kinegraph {

struct ScalingState;

/// The limit that is the nearest one at a time of a motion.
struct NearestLimit {
  enum class Kind { velocity, acceleration, jerk };
  double share = 0.;  ///< of the limit; 1: it is reached
  Kind kind = Kind::acceleration;
  int dof = -1;  ///< -1: nothing moves
};

std::string nearestLimitName(NearestLimit::Kind kind);  ///< "velocity", "acceleration" or "jerk"

/// Returns the limit of which a motion uses the largest share at a state of its time scaling, or at time t (s, clamped
/// to the duration): the reason why it is not faster there. Throws ValueError if there is no motion, for limits of
/// another size, and if t is NaN.
NearestLimit nearestLimit(const PathCurve& curve, int piece, const ScalingState& state, const MotionLimits& limits);
NearestLimit nearestLimit(const TimedPath& motion, double t, const MotionLimits& limits);

}  // namespace kinegraph
