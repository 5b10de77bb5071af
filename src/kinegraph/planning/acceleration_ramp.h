#pragma once

#include "kinegraph/trajectories/path_curve.h"
#include "kinegraph/trajectories/scaling_grid.h"

namespace kinegraph::inline planning_internal {

/// A segment on which all accelerations go to zero, each at its own constant jerk.
struct AccelerationRamp {
  PathCurve curve;       ///< no pieces if the robot hardly moves at the end
  VectorXd q, velocity;  ///< at the end, with zero acceleration
};

/// Computes the ramp from a configuration with a velocity and an acceleration. It keeps the limits of velocity and jerk
/// as far as possible. Along the curve ds/dt is constant, |velocity| at its end; the motion then begins with
/// `acceleration`.
AccelerationRamp rampDown(const VectorXd& q, const VectorXd& velocity, const VectorXd& acceleration,
                          const MotionLimits& limits);

/// Returns the Bernstein coefficients of a piece of a curve; the piece lies in their convex hull.
std::vector<VectorXd> bernsteinOf(const PathCurve& curve, int piece);

}  // namespace kinegraph::inline planning_internal
