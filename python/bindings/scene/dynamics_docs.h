#pragma once

/// The manual of what bind_dynamics.cpp binds.
namespace kinegraph::python::docs::dynamics {

inline constexpr char dyn_MF[] =
    R"(The equation of motion u = M ddq + F at the present q. Gravity is 9.81 m/s^2 along -z; masses, centers of mass and
inertias are those of the frames.

Args:
    q_dot: Velocity of q, shape (n,), rad/s or m/s.
Returns:
    M, shape (n, n), and F, shape (n,), N m or N.
Raises:
    ArgumentError: q_dot has another size.)";

inline constexpr char equationOfMotion[] = R"(The equation of motion, as dyn_MF, also without gravity.

Args:
    qdot: Velocity of q, shape (n,), rad/s or m/s.
    gravity: False leaves gravity out.
Returns:
    M, shape (n, n), and F, shape (n,), N m or N.
Raises:
    ArgumentError: qdot has another size.)";

inline constexpr char inverseDynamics[] =
    R"(The generalized forces that give an acceleration, by recursive Newton-Euler.

Args:
    q_dot: Velocity of q, shape (n,), rad/s or m/s.
    q_ddot: Acceleration of q, shape (n,), rad/s^2 or m/s^2.
Returns:
    Shape (n,), N m or N.
Raises:
    ArgumentError: q_dot or q_ddot have another size.)";

inline constexpr char velocityMap[] =
    R"(The matrix T with dq = T v at the present q. v has an entry per dof, but that a quaternion has an angular velocity
in the axes of what it turns: a free joint has 6 velocities, the linear one in the axes of its parent, then the angular one.

Returns:
    Shape (n, nv).)";

inline constexpr char rigidBodyDynamics[] =
    R"(The terms of M dv + C v + g = u at the present q, in velocities v (see velocityMap), so that M is regular for
floating bases, too. C is such that dM/dt - 2 C is skew.

Args:
    v: Velocities, shape (nv,), rad/s or m/s.
    gravity: False leaves gravity (9.81 m/s^2 along -z) out.
Returns:
    M and C, shape (nv, nv), and g, shape (nv,), N m or N.
Raises:
    ArgumentError: v has another size.)";

inline constexpr char centroidalMomentumMatrix[] =
    R"(The matrix A of the momentum A v of all that moves: the linear one, kg m/s, then the angular one about the common
center of mass, kg m^2/s, in the axes of the world.

Returns:
    Shape (6, nv).)";

}  // namespace kinegraph::python::docs::dynamics
