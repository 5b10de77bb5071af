#pragma once

/// Docstrings of bind_spline_motion.cpp.
namespace kinegraph::python::docs::splineMotion {

inline constexpr char type[] = R"(The trajectory optimization problem of a KOMO with its slices on a B-spline.

Its variables are the control points, few even for many slices. The motion is smooth for any objectives, and can be
executed directly. The spline starts at rest in the initial configuration of the KOMO and moves all of its joints. Joint
limits are bounds of the control points, so the spline satisfies them everywhere. With `addFreeMotion` the spline is
continuously collision-free, and the collision reports of results (`free`) refer to the spline. Other variables, such as
dofs of attached objects, remain variables.

    motion = ry.SplineMotion(komo, points=8)
    result = ry.NLP_Solver(motion.nlp()).solve()
    spline = motion.spline()  # komo has the slices, reports, and so on)";

inline constexpr char make[] = R"(Makes the problem of a KOMO; more objectives can be added before `nlp`.

Args:
    komo: The problem, of order 1 or more. It receives the slices of the solution.
    points: Control points after the start, evenly spaced in time; at most one per slice.
    degree: 1 (linear) to 9; 3 has continuous accelerations.
    ends_at_rest: False adds floor(degree / 2) control points, so that the spline may end in motion.
Raises:
    ArgumentError: The numbers do not fit the KOMO, or its slices do not determine that many control points.)";

inline constexpr char nlp[] = R"(Returns the problem for a solver, which leaves the KOMO's path at its result.

It has the objectives and the start that the KOMO has now; solvers start near its present path.

Returns:
    An NLP in control points.
Raises:
    Error: The KOMO's structure has changed since.)";

inline constexpr char spline[] = R"(Returns the spline through the KOMO's present path.

If no solver has left the path on a spline, it is the best approximation.

Returns:
    A BSpline in s after the start.
Raises:
    Error: Some joints are shared by all slices, and not part of the spline.)";

inline constexpr char isFree[] =
    R"(Checks continuously that the spline through the KOMO's present path is collision-free.

Attached objects move along. The result is True only if it is proved.

Args:
    margin: Minimum distance of all pairs that joints move relative to each other, m. Pairs within margin + 3e-5 may
        count as contacts.
Returns:
    True or False.
Raises:
    ArgumentError: The margin is not finite.)";

}  // namespace kinegraph::python::docs::splineMotion
