#pragma once

/// The manual of what bind_mpc.cpp binds.
namespace kinegraph::python::docs::mpc {

inline constexpr char make[] =
    R"(Copies a motion problem. Slice t lies (t + 1) tau after a call, and objectives keep their slices: an objective at
the last slice is a terminal one.

Args:
    komo: The problem, of order 1 or 2. Its path is the initial guess of the first call.
    evaluations: Budget of a call, at least 2: one step.
    microseconds: A call makes no further step after this time; 0: no limit.
    first_evaluations: Budget of the first call, which has no initial guess and no limit of time.
    tolerance: A step without larger entries ends a call, rad or m.
    violation: Largest accepted violation of a scaled constraint.
    penalty: Initial weight of the squares of constraints.
    receding: False fixes the end of the horizon in time: past slices are constant, mode switches come nearer.
Raises:
    ArgumentError: An option is invalid, the order is 0, the problem has addFreeMotion, or a receding horizon has mode
        switches.)";

inline constexpr char setPoses[] =
    R"(Sets the predicted poses of a frame that no joint moves, and of the frames below it.

Args:
    frame: Its name.
    poses: One row per slice, or one for all: shape (T, 7), x y z in m and qw qx qy qz, or (T, 3), position only.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: Joints move the frame or are below it, or poses has another shape.)";

inline constexpr char updateRootObjects[] =
    R"(Sets all frames that no joint moves, in all slices, to their poses in a scene.

Args:
    config: Scene with the frames and joints of the problem.
Raises:
    ArgumentError: The scene has other frames or joints.)";

inline constexpr char setTarget[] = R"(Sets the target of an objective.

Args:
    objective: Its index, in the order of addObjective, from 0.
    targets: One row of feature components per slice of the objective, or one row for all.
Raises:
    ArgumentError: There is no such objective, targets has another shape, or the feature is an orientation by a
        quaternion.)";

inline constexpr char step[] = R"(Computes the motion from the measured state.

The call shifts path and multipliers of the last call by dt. Not converging is a status: the motion so far stays valid,
and the result describes its quality.

Args:
    q: Measured configuration, shape (n,), rad or m.
    velocity: Measured dq/dt, shape (n,), rad/s or m/s.
    dt: Time since the last call, s, at least 0; None: one slice. The first call ignores it.
Returns:
    A MpcResult.
Raises:
    ArgumentError: An array has another size or entries that are not finite, or dt is negative or not finite; nothing
        changes then.)";

inline constexpr char at[] =
    R"(Evaluates the motion of the last call, at rest after the end.

Between slices the motion is cubic. If a cubic would be faster than the fastest slice, the velocity changes linearly
instead. Limits of velocity that hold in the slices thus hold at all times.

Args:
    time: Time after the last call, s.
Returns:
    q and dq/dt, shape (n,) each.
Raises:
    ArgumentError: time is NaN.)";

inline constexpr char horizon[] = R"(Samples the motion of the last call, from the time of that call to its end.

Args:
    rate: Samples per second, Hz.
Returns:
    Times (T,) in s, q (T, n) and dq/dt (T, n).
Raises:
    ArgumentError: rate is not positive.)";

}  // namespace kinegraph::python::docs::mpc
