#pragma once

/// The manual of what bind_retime.cpp binds.
namespace kinegraph::python::docs::retime {

inline constexpr char ofPath[] =
    R"(The fastest motion along a path that keeps limits of velocity, acceleration and jerk at all times.

Limits are one number for all dofs or one per dof; infinity for none. The motion begins and ends at rest unless told
otherwise; with limits of the jerk it does so without acceleration. Points that equal their predecessor take no time.

Args:
    path: Shape (K, n), rad or m.
    velocity: Limit of |dq/dt|, rad/s or m/s.
    acceleration: Limit of |d2q/dt2|, rad/s^2 or m/s^2.
    jerk: Limit of |d3q/dt3|, rad/s^3 or m/s^3; None for none.
    corners: What becomes of corners: "blend" rounds them within tolerance, "stop" stands still at each, "spline" takes a
        cubic spline through all points, which may be far from the lines cancellation them.
    tolerance: By which a blend may miss its corner, in every dof, rad or m.
    is_free: A function that says whether a blend may be taken: is_free(points, deviation) -> bool, with points (M, n)
        along it, cancellation which it leaves their chords by at most deviation in every dof. Where it says no, smaller
        blends are tried, and then the motion stops at the corner. None: all may be taken.
    start_velocity: dq/dt at the start, shape (n,), along the path; None: at rest.
    end_velocity: dq/dt at the end, shape (n,), along the path; None: at rest.
    intervals: Number of intervals of the time law, on what is curved.
    start_acceleration: d2q/dt2 at the start, shape (n,), with limits of the jerk: what the path's bend and start_velocity
        make, and anything along the path; None: the speed does not change at the start.
Returns:
    TimedPath. If no motion does what is asked, its feasible is False and its message says why.
Raises:
    ArgumentError: A path without points, numbers that are not finite, limits that are not positive, a dof that moves
        without any limit, velocities that do not point along the path, an unknown word for corners.)";

inline constexpr char ofRobot[] =
    R"(The fastest motion of a robot along a path: limits may come from its model.

Args:
    config: The scene; it stays as it is.
    path: Shape (K, n) in the dofs of q, rad or m.
    velocity: Limit of |dq/dt|, one number or one per dof, rad/s or m/s; None: the model's, as C.getVelocityLimits.
    acceleration: Limit of |d2q/dt2|, rad/s^2 or m/s^2; None, with torque only: none.
    jerk: Limit of |d3q/dt3|, rad/s^3 or m/s^3; None for none.
    torque: True keeps the model's torques, as C.getEffortLimits, by its masses and gravity.
    corners: As without config: "blend", "stop", "spline".
    tolerance: By which a blend may miss its corner, in every dof, rad or m.
    is_free: As without config: is_free(points, deviation) -> bool, or None.
    start_velocity: dq/dt at the start, shape (n,), along the path; None: at rest.
    end_velocity: dq/dt at the end, shape (n,), along the path; None: at rest.
    intervals: Number of intervals of the time law, on what is curved.
    start_acceleration: d2q/dt2 at the start, shape (n,), with limits of the jerk: what the path's bend and start_velocity
        make, and anything along the path; None: the speed does not change at the start.
Returns:
    TimedPath. If no motion does what is asked, its feasible is False and its message says why: a joint that cannot
    hold the arm's weight, for example.
Raises:
    ArgumentError: As without config; a path of another number of dofs; limits that the model does not have.)";

}  // namespace kinegraph::python::docs::retime
