#pragma once

/// The manual of what bind_sensitivity.cpp binds.
namespace kinegraph::python::docs::sensitivity {

inline constexpr char ofResult[] =
    R"(How the solution moves with what the problem depends on, by the implicit function theorem. It is brought to
rounding first, and a KOMO is left there.

Args:
    parameters: Each one of
        an objective of a KOMO, by its number or name ("positionDiff of l_gripper, target"): its target, a number per
        row; (objective, "scale"): its scale.
        a frame that rests on its parent: its position, x y z in m, as seen from the parent; (frame, "pose"): that and
        a rotation vector in rad, by which it is turned about its own origin, with axes of the parent: R <- exp(r) R.
        "start": the q that a KOMO begins from.
        ("residual", i): the values that residuals are to have; ("lower", i), ("upper", i): bounds of variables. i is a
        number or a list of them.
    holdWeak: Take constraints that touch without pressing as holding, not as not there.
Returns:
    A Sensitivity.
Raises:
    NotFound: There is no such objective or frame.
    ArgumentError: The solution violates its constraints, or cannot depend on a parameter.
    Error: The exact solution is not found.)";

inline constexpr char ofIkResult[] =
    R"(How the answer moves with its targets: along the shortest way where they leave joints free, else with the posture that
it was to be near to. It is brought to rounding first.

Args:
    targets: Numbers or names of targets (of their frame or feature); none: all. A position or gaze has the numbers x y z
        (m), a pose these and a rotation vector (rad) by which it is turned about its own origin, R <- exp(r) R, a
        direction and a feature those that were given.
    holdWeak: Take pairs and limits that touch without pressing as holding, not as not there.
Returns:
    A Sensitivity, of q.
Raises:
    NotFound: There is no such target.
    ArgumentError: It is no answer, or was loaded.)";

inline constexpr char gradients[] = R"((dq/dp)^T v for each answer, where p are the numbers of all targets (see
IkResult.sensitivity).

Args:
    v: The gradient of something by q, shape (N, n).
    threads: Threads to share the work.
Returns:
    Its gradient by p, shape (N, p); nan for problems without an answer.
Raises:
    ArgumentError: The shape does not fit.)";

inline constexpr char gradient[] =
    R"((dx/dp)^T v: what a function of the solution has as gradient by the parameters, if v is
its gradient by x. It takes one solution of a linear system, however many parameters there are.

Args:
    v: Shape (n,).
Returns:
    Shape (p,).
Raises:
    ArgumentError: The shape does not fit.)";

inline constexpr char columns[] = R"(Which of the p numbers belong to one of the parameters.

Args:
    index: Of the parameter, in the order in which they were asked for.
Returns:
    A slice.
Raises:
    IndexError: There is none.)";

inline constexpr char block[] = R"(The columns of the jacobian that belong to one of the parameters.

Args:
    index: Of the parameter, in the order in which they were asked for.
Returns:
    Shape (n, k).
Raises:
    IndexError: There is none.)";

}  // namespace kinegraph::python::docs::sensitivity
