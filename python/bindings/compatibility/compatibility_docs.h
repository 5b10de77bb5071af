#pragma once

/// The manual of what bind_compatibility.cpp binds.
namespace kinegraph::python::docs::compatibility {

inline constexpr char selectJointsByTag[] =
    R"(Makes the joints at frames that have one of some attributes the active ones, and no others.

Args:
    jointGroups: Names of the attributes.
    notThose: All joints but these become active.
Raises:
    ArgumentError: No frame has one of these attributes.)";

inline constexpr char makeObjectsFree[] =
    R"(Lets objects move freely: the nearest joint at or above each of these frames becomes a free one, where it is. Roots
are attached to the first frame of the scene.

Args:
    frameNames: Names of the frames.
Raises:
    FrameNotFound: A name that is not in the scene.)";

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

}  // namespace kinegraph::python::docs::compatibility
