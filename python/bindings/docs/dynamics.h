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

inline constexpr char equationOfMotion[] = R"(dyn_MF, as scripts of earlier years call it, also without gravity.

Args:
    qdot: Velocity of q, shape (n,), rad/s or m/s.
    gravity: False leaves gravity out.
Returns:
    M, shape (n, n), and F, shape (n,), N m or N.
Raises:
    ArgumentError: qdot has another size.)";

inline constexpr char stepDynamics[] = R"(Moves q by one Runge-Kutta step of the equation of motion, without contacts.

Args:
    qdot: Velocity of q at first, shape (n,), rad/s or m/s.
    u_control: Generalized forces, shape (n,), N m or N.
    tau: Length of the step, s.
    dynamicNoise: Standard deviation of accelerations that are added, rad/s^2 or m/s^2.
    gravity: False leaves gravity out.
Returns:
    The velocity after the step, shape (n,).
Raises:
    ArgumentError: qdot or u_control have another size.)";

inline constexpr char inverseDynamics[] =
    R"(The generalized forces that give an acceleration, by recursive Newton-Euler.

Args:
    q_dot: Velocity of q, shape (n,), rad/s or m/s.
    q_ddot: Acceleration of q, shape (n,), rad/s^2 or m/s^2.
Returns:
    Shape (n,), N m or N.
Raises:
    ArgumentError: q_dot or q_ddot have another size.)";

}  // namespace kinegraph::python::docs::dynamics
