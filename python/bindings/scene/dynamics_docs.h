#pragma once

/// Docstrings for bind_dynamics.cpp.
namespace kinegraph::python::docs::dynamics {

inline constexpr char dyn_MF[] =
    R"(Computes the equation of motion u = M ddq + F at the current q. Gravity is 9.81 m/s^2 along -z.

Masses, centers of mass and inertias are those of the frames.

Args:
    q_dot: Velocity of q, shape (n,), rad/s or m/s.
Returns:
    M, shape (n, n), and F, shape (n,), N m or N.
Raises:
    ArgumentError: q_dot has another size.)";

inline constexpr char equationOfMotion[] = R"(Computes the equation of motion, as dyn_MF, optionally without gravity.

Args:
    qdot: Velocity of q, shape (n,), rad/s or m/s.
    gravity: False omits gravity.
Returns:
    M, shape (n, n), and F, shape (n,), N m or N.
Raises:
    ArgumentError: qdot has another size.)";

inline constexpr char inverseDynamics[] =
    R"(Computes the generalized forces for an acceleration, by recursive Newton-Euler.

Args:
    q_dot: Velocity of q, shape (n,), rad/s or m/s.
    q_ddot: Acceleration of q, shape (n,), rad/s^2 or m/s^2.
Returns:
    Shape (n,), N m or N.
Raises:
    ArgumentError: q_dot or q_ddot has another size.)";

inline constexpr char velocityMap[] =
    R"(Computes the matrix T with dq = T v at the current q.

v has one entry per dof; only a quaternion has three, its angular velocity in the axes of the rotated frame. A free
joint has 6 velocities: the linear velocity in the axes of its parent, then the angular velocity.

Returns:
    Shape (n, nv).)";

inline constexpr char rigidBodyDynamics[] =
    R"(Computes the terms of M dv + C v + g = u at the current q.

v are velocities (see velocityMap), so M is regular for floating bases, too. dM/dt - 2 C is skew-symmetric.

Args:
    v: Velocities, shape (nv,), rad/s or m/s.
    gravity: False omits gravity (9.81 m/s^2 along -z).
Returns:
    M and C, shape (nv, nv), and g, shape (nv,), N m or N.
Raises:
    ArgumentError: v has another size.)";

inline constexpr char centroidalMomentumMatrix[] =
    R"(Computes the matrix A of the momentum A v of all moving links.

A v is the linear momentum, kg m/s, then the angular momentum about the common center of mass, kg m^2/s, both in world
axes.

Returns:
    Shape (6, nv).)";

}  // namespace kinegraph::python::docs::dynamics
