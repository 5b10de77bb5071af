#pragma once

#include "kinegraph/kinematics/dynamics.h"

namespace kinegraph {

/// Dynamics in velocities v instead of dq. They are those of q, but that each quaternion (4 dofs, of which 3 are free)
/// has an angular velocity (3 numbers, rad/s) in the axes of what it turns. A free joint has 6: the linear velocity in
/// the axes of its parent, m/s, and the angular velocity in its own. Mass matrices are regular then.
///
///     dq = T(q) v                                   velocityMap, n x nv
///     M(q) dv + C(q, v) v + g(q) = u                rigidBodyDynamics
///     h = A(q) v                                    centroidalMomentum
struct RigidBodyDynamics {
  MatrixXd M;  ///< nv x nv, kg, kg m, kg m^2
  MatrixXd C;  ///< nv x nv; dM/dt - 2 C is skew
  VectorXd g;  ///< nv: generalized forces that hold q against gravity, N m, N
};

/// The number nv of velocities.
int velocityDimension(const KinematicModel& model);

/// T(q). Moving along it keeps the norms of quaternions.
MatrixXd velocityMap(const State& state);

/// M, C (by Christoffel's symbols) and g. `v` has velocityDimension entries, or ValueError is thrown.
/// Source: Echeandia & Wensing, Numerical methods to compute the Coriolis matrix and Christoffel symbols, 2021.
RigidBodyDynamics rigidBodyDynamics(const State& state, const std::vector<LinkInertia>& inertias, const VectorXd& v,
                                    const Vector3d& gravity = kGravity);

/// A, 6 x nv: the momentum of all that moves is A v, first the linear one, kg m/s, then the angular one about the common
/// center of mass, kg m^2/s, in the axes of the world.
/// Source: Orin, Goswami & Lee, Centroidal dynamics of a humanoid robot, 2013.
MatrixXd centroidalMomentumMatrix(const State& state, const std::vector<LinkInertia>& inertias);

}  // namespace kinegraph
