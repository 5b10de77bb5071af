#pragma once

#include "kinegraph/kinematics/joint.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

// Dynamics of a scene in velocity coordinates at its current q; see kinematics/velocity_dynamics.h.

int velocityDimension(const Config& config);

MatrixXd velocityMap(const Config& config);

RigidBodyDynamics rigidBodyDynamics(const Config& config, const VectorXd& v, const Vector3d& gravity = kGravity);

MatrixXd centroidalMomentumMatrix(const Config& config);

/// Velocity limit of each dof of q (rad/s or m/s of q): the first number of `ctrl_limits` (velocity, effort, ...; from
/// URDF <limit velocity effort/>) of its joint and of the joints mimicking it. Infinite if not given, for a number <=
/// 0, and for the dofs of quaternions and circles, which are not angles.
VectorXd getVelocityLimits(const Config& config);

/// Force or torque limit of each dof of q, N or Nm: the second number of `ctrl_limits` of its joint. Infinite if not
/// given.
VectorXd getEffortLimits(const Config& config);

}  // namespace kinegraph
