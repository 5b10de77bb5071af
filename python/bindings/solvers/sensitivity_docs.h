#pragma once

/// The manual of what bind_sensitivity.cpp binds.
namespace kinegraph::python::docs::sensitivity {

inline constexpr char ofResult[] =
    R"(Computes how the solution moves with parameters of the problem, by the implicit function theorem.

The solution is first refined to rounding errors, and a KOMO is left there.

Args:
    parameters: Each one of
        an objective of a KOMO, by its number or name ("positionDiff of l_gripper, target"): its target, one number per
        component; (objective, "scale"): its scale.
        a frame that is fixed to its parent: its position relative to the parent, x y z in m; (frame, "pose"): also a
        rotation vector in rad, which rotates the frame about its own origin, with axes of the parent: R <- exp(r) R.
        "start": the initial q of a KOMO.
        ("residual", i): the targets of residuals; ("lower", i), ("upper", i): bounds of variables. i is an index or a
        list of indices.
    holdWeak: True counts weakly active constraints (active with multiplier zero) as active.
Returns:
    A Sensitivity.
Raises:
    NotFound: There is no such objective or frame.
    ArgumentError: The solution violates its constraints, or cannot depend on a parameter.
    Error: The refinement of the solution fails.)";

inline constexpr char ofIkResult[] =
    R"(Computes how the answer moves with its targets: by the shortest dq if they leave joints free, else with the
posture that the answer stays close to. The answer is first refined to rounding errors.

Args:
    targets: Numbers or names of targets (of their frame or feature); none: all. A position or gaze has the parameters x
        y z (m). A pose has these and a rotation vector (rad), which rotates it about its own origin, R <- exp(r) R.
        Directions and features have the given numbers.
    holdWeak: True counts weakly active pairs and limits as active.
Returns:
    A Sensitivity of q.
Raises:
    NotFound: There is no such target.
    ArgumentError: The result is not solved, or was loaded.)";

inline constexpr char gradients[] =
    R"(Computes (dq/dp)^T v for each answer, where p are the parameters of all targets (see IkResult.sensitivity).

Args:
    v: The gradient of a function of q, shape (N, n).
    threads: Number of threads.
Returns:
    The gradient with respect to p, shape (N, p); nan for problems without an answer.
Raises:
    ArgumentError: v has another shape.)";

inline constexpr char gradient[] =
    R"(Computes (dx/dp)^T v: the gradient with respect to the parameters of a function of x with gradient v.

It solves one linear system for any number of parameters.

Args:
    v: Shape (n,).
Returns:
    Shape (p,).
Raises:
    ArgumentError: v has another shape.)";

inline constexpr char columns[] = R"(Returns the columns of a parameter in the jacobian.

Args:
    index: Index of the parameter, in the order of the call.
Returns:
    A slice.
Raises:
    IndexError: There is no such parameter.)";

inline constexpr char block[] = R"(Returns the part of the jacobian that belongs to a parameter.

Args:
    index: Index of the parameter, in the order of the call.
Returns:
    Shape (n, k).
Raises:
    IndexError: There is no such parameter.)";

}  // namespace kinegraph::python::docs::sensitivity
