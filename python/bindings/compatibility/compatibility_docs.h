#pragma once

/// Docstrings for bind_compatibility.cpp.
namespace kinegraph::python::docs::compatibility {

inline constexpr char selectJointsByTag[] =
    R"(Activates exactly the joints at frames with one of some attributes.

Args:
    jointGroups: Names of the attributes.
    notThose: Activates all other joints instead.
Raises:
    ArgumentError: No frame has one of these attributes.)";

inline constexpr char makeObjectsFree[] =
    R"(Makes objects free: the nearest joint at or above each of these frames becomes a free joint at its current pose.

Roots are attached to the first frame of the scene.

Args:
    frameNames: Names of the frames.
Raises:
    FrameNotFound: A name is not in the scene.)";

inline constexpr char stepDynamics[] =
    R"(Advances q by one Runge-Kutta step of the equation of motion, without contacts.

Args:
    qdot: Velocity of q before the step, shape (n,), rad/s or m/s.
    u_control: Generalized forces, shape (n,), N m or N.
    tau: Duration of the step, s.
    dynamicNoise: Standard deviation of added random accelerations, rad/s^2 or m/s^2.
    gravity: False omits gravity.
Returns:
    The velocity after the step, shape (n,).
Raises:
    ArgumentError: qdot or u_control has another size.)";

}  // namespace kinegraph::python::docs::compatibility
