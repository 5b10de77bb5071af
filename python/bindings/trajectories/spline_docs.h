#pragma once

/// The docstrings of BSpline in bind_spline.cpp.
namespace kinegraph::python::docs::spline {

inline constexpr char type[] = R"(A motion x(t) of d dofs as a B-spline. Setters return the spline itself.

Points have times (s). A spline of degree 2 or more comes near the inner points, but does not pass through them. The
first and the last point are repeated floor(degree / 2) times (duplicates): the spline starts and ends at them, at rest
or with a given velocity. Before its start it stays at the first point, from its end on at the last one, with zero
derivatives.)";

inline constexpr char make[] = R"(Creates an empty spline; call set.)";

inline constexpr char setKnots[] = R"(Sets the knots for points at given times, and removes the control points.

The first and the last time are knots degree + 1 times. Between them, the knots of an odd degree are the inner times,
those of an even degree the midpoints of neighbors.

Args:
    degree: 0 (steps) to 9; 2 or 3 is smooth.
    times: (n,) in s, not decreasing.
Returns:
    The spline itself.
Raises:
    ArgumentError: There are fewer than two times, times decrease or are all equal, or the degree is out of range.)";

inline constexpr char setCtrlPoints[] = R"(Sets the points, after setKnots.

Args:
    points: (n, d), or (n,) for a spline of one dof.
    addStartDuplicates: True repeats the first point; False if its duplicates are among the points.
    addEndDuplicates: The same for the last point.
    setStartVel: (d,), velocity at the start, by moving the duplicates there; empty: none.
    setEndVel: (d,), velocity at the end.
Returns:
    The spline itself.
Raises:
    ArgumentError: There are no knots, or sizes do not match them.)";

inline constexpr char set[] =
    R"(Sets points and their times: setKnots and setCtrlPoints in one. An error changes nothing.

Args:
    degree: 0 to 9.
    points: (n, d), or (n,) for a spline of one dof.
    times: (n,) in s, not decreasing.
    setStartVel: (d,), velocity at the start; empty: at rest.
    setEndVel: (d,), velocity at the end.
Returns:
    The spline itself.
Raises:
    ArgumentError: Sizes do not match, times decrease, or numbers are not finite.)";

inline constexpr char append[] = R"(Appends points after the present end. An error changes nothing.

Args:
    points: (k, d); one point may be (d,).
    times_rel: (k,) in s, after the present end.
    inside: False: the spline passes through its previous end, at rest if it ended at rest, else with its velocity.
        True: the previous end becomes an inner point, which the spline only comes near.
Returns:
    The spline itself.
Raises:
    ArgumentError: The spline is empty, sizes do not match, or times decrease or are negative.)";

inline constexpr char overwriteSmooth[] =
    R"(Replaces the spline by one that starts with its position and velocity at a time.

Args:
    points: (k, d); one point may be (d,).
    times_rel: (k,) in s, after time_cut.
    time_cut: Start of the new spline, s.
Returns:
    The spline itself.
Raises:
    ArgumentError: The spline is empty, sizes do not match, or times decrease.)";

inline constexpr char eval[] = R"(Evaluates the motion at several times, or a derivative of it.

Args:
    sampleTimes: (m,) in s, or one time.
    derivative: 0 position, 1 velocity, 2 acceleration, and so on.
Returns:
    (m, d).
Raises:
    ArgumentError: The spline is empty, the derivative is negative, or a time is NaN.)";

inline constexpr char eval3[] = R"(Evaluates position, velocity and acceleration at a time.

Args:
    time: s.
Returns:
    (3, d).
Raises:
    ArgumentError: The spline is empty, or time is NaN.)";

inline constexpr char getBmatrix[] = R"(Returns the matrix B of x = B c with the control points c.

Args:
    sampleTimes: (m,) in s.
    startDuplicates: True adds the columns of the first point's duplicates to its own column.
    endDuplicates: The same for the last point. With both, B multiplies the n points without duplicates.
Returns:
    (m, number of control points), or fewer columns.
Raises:
    ArgumentError: There are no knots, or a time is NaN.)";

inline constexpr char getKnots[] = R"(Returns the knots, (count,) in s: one per control point, and degree + 1 more.)";

inline constexpr char getCtrlPoints[] = R"(Returns the control points with duplicates, (count, d).)";

}  // namespace kinegraph::python::docs::spline
