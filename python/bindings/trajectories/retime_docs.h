#pragma once

/// The docstrings of bind_retime.cpp.
namespace kinegraph::python::docs::retime {

inline constexpr char ofPath[] =
    R"(Computes the fastest motion along a path within limits of velocity, acceleration and jerk, which hold at all
times.

Limits are one number for all dofs or one per dof; infinity for none. The motion starts and ends at rest unless
velocities are passed; with jerk limits it does so without acceleration. Points that equal their predecessor take no
time.

Args:
    path: Shape (K, n), rad or m.
    velocity: Limit of |dq/dt|, rad/s or m/s.
    acceleration: Limit of |d2q/dt2|, rad/s^2 or m/s^2.
    jerk: Limit of |d3q/dt3|, rad/s^3 or m/s^3; None for none.
    corners: "blend" rounds corners within tolerance, "stop" stops at each, "spline" takes a cubic spline through all
        points, which may deviate far from the lines between them.
    tolerance: Largest distance of a blend from its corner, in every dof, rad or m.
    is_free: Checks a blend for collisions: is_free(points, deviation) -> bool, with points (M, n) on the blend, which
        deviates from the chords between them by at most deviation in every dof. After False, smaller blends are tried,
        then the motion stops at the corner. None: all blends are free.
    start_velocity: dq/dt at the start, shape (n,), along the path; None: at rest.
    end_velocity: dq/dt at the end, shape (n,), along the path; None: at rest.
    intervals: Number of intervals of the time scaling, on curved parts.
    start_acceleration: d2q/dt2 at the start, shape (n,), for motions with jerk limits: the acceleration that the
        curvature of the path requires at start_velocity, plus a multiple of start_velocity; None: a constant speed at
        the start.
Returns:
    TimedPath. If the problem is infeasible, its feasible is False and its message gives the cause.
Raises:
    ArgumentError: The path has no points, numbers are not finite, limits are not positive, a moving dof has no limit,
        velocities do not point along the path, or corners is unknown.)";

inline constexpr char nearestLimit[] =
    R"(Returns the limit of which the motion uses the largest share at a time: why it is not faster there.

Args:
    t: Time, s, clamped to the duration.
    velocity: Limit of |dq/dt| of the call, a number or one per dof.
    acceleration: Limit of |d2q/dt2|, likewise.
    jerk: Limit of |d3q/dt3|, likewise; None for none.
Returns:
    The share (1: the limit is reached), "velocity", "acceleration" or "jerk", and the index of the dof (-1 at rest).
Raises:
    ArgumentError: There is no motion, a limit is not positive or has another size, or t is NaN.)";

inline constexpr char firstContact[] =
    R"(Finds the first time at which the motion is not provably free: continuously, not only at samples.

Args:
    config: The scene.
    margin: Distance that all pairs keep, m.
Returns:
    None if the whole motion is free; else the time (s), the names of both frames, and their distance (m).
Raises:
    ArgumentError: There is no motion, the scene has another number of dofs, or the margin is negative.)";

inline constexpr char ofRobot[] =
    R"(Computes the fastest motion of a robot along a path; its limits may come from the model.

Args:
    config: The scene; not changed.
    path: Shape (K, n) in the dofs of q, rad or m.
    velocity: Limit of |dq/dt|, one number or one per dof, rad/s or m/s; None: the model's, as C.getVelocityLimits.
    acceleration: Limit of |d2q/dt2|, rad/s^2 or m/s^2; None, with torque only: none.
    jerk: Limit of |d3q/dt3|, rad/s^3 or m/s^3; None for none.
    torque: True keeps the model's torque limits, as C.getEffortLimits, by its masses and gravity.
    corners: As without config: "blend", "stop", "spline".
    tolerance: Largest distance of a blend from its corner, in every dof, rad or m.
    is_free: As without config: is_free(points, deviation) -> bool, or None.
    start_velocity: dq/dt at the start, shape (n,), along the path; None: at rest.
    end_velocity: dq/dt at the end, shape (n,), along the path; None: at rest.
    intervals: Number of intervals of the time scaling, on curved parts.
    start_acceleration: d2q/dt2 at the start, shape (n,), for motions with jerk limits: the acceleration that the
        curvature of the path requires at start_velocity, plus a multiple of start_velocity; None: a constant speed at
        the start.
    tool_speed: Largest speeds of the origins of frames in the world: a dict from names to m/s.
Returns:
    TimedPath. If the problem is infeasible, its feasible is False and its message gives the cause, such as a joint that
    cannot hold the arm's weight.
Raises:
    ArgumentError: As without config; the path has another number of dofs, or the model lacks a limit.)";

inline constexpr char ofMotion[] =
    R"(Computes the fastest motion along the way of another motion, whose times do not count.

The way is that of a spline (SplineTrajectory), a plan, a tool path or any other Trajectory. It is followed within 1e-6
rad or m, that of a TimedPath exactly. The motion stops where the direction jumps.

Args:
    config: The scene; not changed.
    motion: A Trajectory in the dofs of q.
    velocity: Limit of |dq/dt|, one number or one per dof, rad/s or m/s; None: the model's, as C.getVelocityLimits.
    acceleration: Limit of |d2q/dt2|, rad/s^2 or m/s^2; None, with torque only: none.
    jerk: Limit of |d3q/dt3|, rad/s^3 or m/s^3; None for none.
    torque: True keeps the model's torque limits, as C.getEffortLimits, by its masses and gravity.
    start_velocity: dq/dt at the start, shape (n,), along the way; None: at rest.
    end_velocity: dq/dt at the end, shape (n,), along the way; None: at rest.
    intervals: Number of intervals of the time scaling. Limits of torques and of speeds hold at their ends, and are made
        stricter so that they hold in between: more intervals give a shorter motion.
    start_acceleration: d2q/dt2 at the start, shape (n,), as with a path; None: a constant speed at the start.
    tool_speed: Largest speeds of the origins of frames in the world: a dict from names to m/s.
Returns:
    TimedPath. If the problem is infeasible, its feasible is False and its message gives the cause.
Raises:
    ArgumentError: As with a path, or there is no motion.)";

inline constexpr char activeLimits[] =
    R"(Returns the limits that make a motion as slow as it is.

Args:
    config: The scene; not changed.
    motion: A TimedPath, as retime returns it.
    velocity: Limit of |dq/dt| of the call, a number or one per dof; None: the model's.
    acceleration: Limit of |d2q/dt2|, likewise; None, with torque only: none.
    jerk: Limit of |d3q/dt3|, likewise; None for none.
    torque: Whether the model's torque limits count.
    tool_speed: Largest speeds of the origins of frames in the world: a dict from names to m/s.
Returns:
    A list of (from, to, share, cause) in the order of time: times in s, the largest share of the limit there (1: it is
    reached), and the limit, such as "velocity of 'elbow'", "torque of 'elbow'" or "speed of 'tool'".
Raises:
    ArgumentError: There is no motion, or a limit is missing, not positive, or has another size.)";

}  // namespace kinegraph::python::docs::retime
