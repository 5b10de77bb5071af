#pragma once

/// The manual of what bind_spline_motion.cpp binds.
namespace kinegraph::python::docs::splineMotion {

inline constexpr char type[] = R"(The motion problem of a KOMO, whose slices lie on a B-spline.

Its variables are the control points: few of them for many slices. The motion is smooth whatever the objectives are, and can be
executed as it is. It begins at rest in the configuration that the KOMO was given, and takes all of its joints; limits of joints are
bounds of the control points, so that they hold at all times. Where its motion is to be free at all times (`addFreeMotion`) the spline
is, and what results say of that (`free`) is said of the spline. Other variables, as of objects that are held, stay as they are.

    motion = ry.SplineMotion(komo, points=8)
    result = ry.NLP_Solver(motion.nlp()).solve()
    spline = motion.spline()  # and komo has the slices, reports, and so on)";

inline constexpr char make[] = R"(Takes a KOMO with its objectives; more can be added before `nlp`.

Args:
    komo: The problem, of order 1 or more. It is kept, and has the solution's slices later.
    points: Control points behind the start, equally far apart in time; at most one per slice.
    degree: 1 (lines) to 9; 3 has continuous accelerations.
    ends_at_rest: Else there are floor(degree / 2) control points more, so that the spline may end in motion.
Raises:
    ArgumentError: Numbers that do not fit the KOMO; more control points than its slices can tell apart.)";

inline constexpr char nlp[] = R"(The problem for a solver, which leaves the KOMO's path at its result.

With the objectives and the start that the KOMO has now; solvers begin near to its present path.

Returns:
    An NLP in control points.
Raises:
    Error: The KOMO's structure has changed since.)";

inline constexpr char spline[] = R"(The spline through the KOMO's present path.

The nearest one, where no solver has left it there.

Returns:
    A BSpline in s from the start on.
Raises:
    Error: Some joints are shared by all slices, and no part of the spline.)";

inline constexpr char isFree[] =
    R"(Do all pairs of shapes that joints move apart keep a distance on the spline, at all times?

Of the spline through the KOMO's present path; what is held moves along. True only where it is proved.

Args:
    margin: m; of pairs within margin + 3e-5 the answer may be no.
Returns:
    True or False.
Raises:
    ArgumentError: A margin that is not finite.)";

}  // namespace kinegraph::python::docs::splineMotion
