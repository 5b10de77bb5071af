#pragma once

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// How fast each dof of q may change: rad/s or m/s of q, from the first number of `ctrl_limits` (velocity, effort, ...;
/// of URDF files <limit velocity effort/>) of its joint and of those that mimic it. Infinite where nothing is said, for a
/// number that is not positive, and for the dofs of quaternions and circles, which are no angles.
VectorXd getVelocityLimits(const Config& config);

/// The force or torque with which each dof of q may be driven, N or Nm, from the second number of `ctrl_limits` of its
/// joint. Infinite where nothing is said.
VectorXd getEffortLimits(const Config& config);

}  // namespace kinegraph
