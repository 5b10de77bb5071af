#pragma once

#include "kinegraph/trajectories/path_curve.h"
#include "kinegraph/trajectories/scaling_grid.h"

namespace kinegraph {

/// Where a robot goes whose accelerations go to zero, each dof's at a constant jerk of its own.
struct AccelerationRamp {
  PathCurve curve;  ///< its direction and its bend begin as the velocity and the acceleration say; no pieces: see below
  VectorXd q, velocity;  ///< at its end, where nothing accelerates
};

/// From a posture with a velocity and an acceleration, within limits of velocity and jerk as far as they can be kept. Going
/// along the curve at a constant ds/dt, which is |velocity| at its end, has the accelerations of the start at first. Where
/// it would hardly move at the end, there is no curve.
AccelerationRamp rampDown(const VectorXd& q, const VectorXd& velocity, const VectorXd& acceleration,
                          const MotionLimits& limits);

/// The Bernstein coefficients of a piece of a curve.
std::vector<VectorXd> bernsteinOf(const PathCurve& curve, int piece);

}  // namespace kinegraph
