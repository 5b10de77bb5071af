#pragma once

#include "kinegraph/kinematics/dynamics.h"

namespace kinegraph {

/// Dynamics in velocities v instead of dq. They equal dq except for quaternions: these 4 dofs, of which 3 are free,
/// have an angular velocity (3 numbers, rad/s) in the axes of the moved link. A free joint has 6 velocities: the linear
/// one in the axes of its parent, m/s, and the angular one in its own axes. Mass matrices are regular then.
///
///     dq = T(q) v                                   velocityMap, n x nv
///     M(q) dv + C(q, v) v + g(q) = u                rigidBodyDynamics
///     h = A(q) v                                    centroidalMomentum
struct RigidBodyDynamics {
  MatrixXd M;  ///< nv x nv, kg, kg m, kg m^2
  MatrixXd C;  ///< nv x nv; dM/dt - 2 C is skew
  VectorXd g;  ///< nv: generalized forces that balance gravity, N m, N
};

/// Returns the number nv of velocities.
int velocityDimension(const KinematicModel& model);

/// Returns T(q). Motion along it preserves the norms of quaternions.
MatrixXd velocityMap(const State& state);

/// Computes M, C (from Christoffel symbols) and g. Throws ValueError unless `v` has velocityDimension entries.
/// Source: Echeandia & Wensing, Numerical methods to compute the Coriolis matrix and Christoffel symbols, 2021.
RigidBodyDynamics rigidBodyDynamics(const State& state, const std::vector<LinkInertia>& inertias, const VectorXd& v,
                                    const Vector3d& gravity = kGravity);

/// Computes A, 6 x nv. The momentum of everything that moves is A v: first the linear one, kg m/s, then the angular one
/// about the common center of mass, kg m^2/s, in the axes of the world.
/// Source: Orin, Goswami & Lee, Centroidal dynamics of a humanoid robot, 2013.
MatrixXd centroidalMomentumMatrix(const State& state, const std::vector<LinkInertia>& inertias);

}  // namespace kinegraph
