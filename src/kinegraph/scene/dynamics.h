#pragma once

#include "kinegraph/kinematics/joint.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

// Dynamics of a scene in velocity coordinates at its current q; see kinematics/velocity_dynamics.h.

/// Returns the number of velocity coordinates: those of q, with three for each quaternion.
int velocityDimension(const Config& config);

/// Returns the matrix (velocityDimension, n) that maps dq/dt to velocity coordinates.
MatrixXd velocityMap(const Config& config);

/// Returns the mass matrix, the Coriolis matrix and the gravity forces at velocity v; gravity in m/s^2.
RigidBodyDynamics rigidBodyDynamics(const Config& config, const VectorXd& v, const Vector3d& gravity = kGravity);

/// Returns the matrix that maps velocity coordinates to the momentum about the center of mass.
MatrixXd centroidalMomentumMatrix(const Config& config);

/// Velocity limit of each dof of q (rad/s or m/s of q): the first number of `ctrl_limits` (velocity, effort, ...; from
/// URDF <limit velocity effort/>) of its joint and of the joints mimicking it. Infinite if not given, for a number <=
/// 0, and for the dofs of quaternions and circles, which are not angles.
VectorXd getVelocityLimits(const Config& config);

/// Force or torque limit of each dof of q, N or Nm: the second number of `ctrl_limits` of its joint. Infinite if not
/// given.
VectorXd getEffortLimits(const Config& config);

}  // namespace kinegraph
