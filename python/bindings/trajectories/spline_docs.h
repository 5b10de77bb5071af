#pragma once

/// The manual of what bind_spline.cpp binds.
namespace kinegraph::python::docs::spline {

inline constexpr char type[] = R"(A motion x(t) of d numbers as a B-spline. Setters return the spline itself.

Points stand at times (s). A spline of degree 2 or more comes near inner points and does not pass through them; the first and
the last are repeated floor(degree / 2) times (duplicates), so that it starts and ends at them, at rest or with a given
velocity. Before it starts it is at the first point, from its end on at the last one, with zero derivatives.)";

inline constexpr char make[] = R"(An empty spline; call set.)";

inline constexpr char setKnots[] = R"(Takes the times of the points to come, and forgets the control points.

The first and the last time are knots degree + 1 times. Between them, knots of an odd degree are the inner times, those of an
even one the midpoints of neighbors.

Args:
    degree: 0 (steps) to 9; 2 or 3 is smooth.
    times: (n,) in s, not falling.
Returns:
    The spline itself.
Raises:
    ArgumentError: Less than two times, times that fall or are all the same, or another degree.)";

inline constexpr char setCtrlPoints[] = R"(Takes the points, after setKnots.

Args:
    points: (n, d), or (n,) of a spline of one number.
    addStartDuplicates: Repeat the first point; else its duplicates are among the points.
    addEndDuplicates: The same for the last one.
    setStartVel: (d,), velocity at the start: moves the duplicates there, which are then no duplicates. None if empty.
    setEndVel: (d,), velocity at the end.
Returns:
    The spline itself.
Raises:
    ArgumentError: There are no knots, or sizes do not match them.)";

inline constexpr char set[] =
    R"(Takes points and their times: setKnots and setCtrlPoints in one. On an error nothing changes.

Args:
    degree: 0 to 9.
    points: (n, d), or (n,) of a spline of one number.
    times: (n,) in s, not falling.
    setStartVel: (d,), velocity at the start. None if empty.
    setEndVel: (d,), velocity at the end.
Returns:
    The spline itself.
Raises:
    ArgumentError: Sizes do not match, times fall, numbers are not finite.)";

inline constexpr char append[] = R"(Goes on to more points after the present end. On an error nothing changes.

Args:
    points: (k, d); one point may be (d,).
    times_rel: (k,) in s, after the end of what is there.
    inside: False: the motion passes through what was its end; at rest if it ended at rest, else with its velocity. True: that
        point becomes an inner one, which the motion only comes near.
Returns:
    The spline itself.
Raises:
    ArgumentError: The spline is empty, sizes do not match, times fall or are negative.)";

inline constexpr char overwriteSmooth[] = R"(Forgets all but position and velocity at a time, and goes on from there.

Args:
    points: (k, d); one point may be (d,).
    times_rel: (k,) in s, after time_cut.
    time_cut: When the new motion starts, s.
Returns:
    The spline itself.
Raises:
    ArgumentError: The spline is empty, sizes do not match, times fall.)";

inline constexpr char eval[] = R"(The motion at times, or a derivative of it.

Args:
    sampleTimes: (m,) in s, or one time.
    derivative: 0 position, 1 velocity, 2 acceleration, and so on.
Returns:
    (m, d).
Raises:
    ArgumentError: The spline is empty, the derivative negative, or a time is not a number.)";

inline constexpr char eval3[] = R"(Position, velocity and acceleration at a time.

Args:
    time: s.
Returns:
    (3, d).
Raises:
    ArgumentError: The spline is empty, or t is not a number.)";

inline constexpr char getBmatrix[] = R"(The matrix B of x = B c, c the control points.

Args:
    sampleTimes: (m,) in s.
    startDuplicates: Add the columns of the first point's duplicates to its own.
    endDuplicates: The same for the last point. With both, B multiplies the n points without duplicates.
Returns:
    (m, number of control points), or fewer columns.
Raises:
    ArgumentError: There are no knots, or a time is not a number.)";

inline constexpr char getKnots[] = R"(The knots, in s: (count,), as many as control points and degree + 1.)";

inline constexpr char getCtrlPoints[] = R"(The control points, duplicates included: (count, d).)";

}  // namespace kinegraph::python::docs::spline
