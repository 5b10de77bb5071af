#pragma once

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// Inertial parameters of a link. Link 0 is the world; its inertia has no effect.
struct LinkInertia {
  double mass = 0.;                    ///< kg
  Vector3d com = Vector3d::Zero();     ///< center of mass in the link, m
  Matrix3d matrix = Matrix3d::Zero();  ///< about the center of mass, in the link's axes, kg m^2

  /// Adds a rigidly attached part; `X_LF` is its pose in the link.
  void add(const LinkInertia& part, const RigidTransform& X_LF);
};

inline const Vector3d kGravity{0., 0., -9.81};  ///< m/s^2

/// The equation of motion u = M(q) ddq + F(q, dq), with generalized forces u (N m, N).
struct EquationOfMotion {
  MatrixXd M;  ///< n x n
  VectorXd F;  ///< n: Coriolis, centrifugal and gravity terms
};

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

}  // namespace kinegraph
