#pragma once

/// The manual of what bind_mpc.cpp binds.
namespace kinegraph::python::docs::mpc {

inline constexpr char make[] =
    R"(For a motion problem, of which it takes a copy. Slice t lies (t + 1) tau after a call, and its objectives stay where
they are in the horizon: one at the last slice is a terminal one.

Args:
    komo: The problem, of order 1 or 2. Its path is where the first call starts.
    evaluations: Most of them in a call, at least 2: one step.
    microseconds: After which a call makes no further step; 0: any time.
    first_evaluations: Most of them in the first call, which knows nothing and has no other budget.
    tolerance: A step with no larger entry ends a call, rad or m.
    violation: Violation of a scaled constraint that counts as none.
    penalty: First weight of the squares of constraints.
    receding: False: the end stays where it is in time; past slices are given, mode switches come nearer.
Raises:
    ArgumentError: An option that makes no sense, a problem of order 0, addFreeMotion, or mode switches that cannot recede.)";

inline constexpr char setPoses[] = R"(Where a frame will be that no joint moves, with what hangs below it.

Args:
    frame: Its name.
    poses: A row per slice, or one for all: shape (T, 7), x y z in m and qw qx qy qz, or (T, 3), position alone.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: Joints move the frame or hang below it, or the shape does not fit.)";

inline constexpr char updateRootObjects[] =
    R"(Puts all frames that no joint moves, in all slices, to where they are in a scene.

Args:
    config: With the frames and joints of the scene that the problem was made from.
Raises:
    ArgumentError: It has other frames or joints.)";

inline constexpr char setTarget[] = R"(Changes the target of an objective.

Args:
    objective: Its number, in the order in which objectives were added, from 0.
    targets: A row per slice of the objective, or one for all, of the feature's numbers.
Raises:
    ArgumentError: There is no such objective, the shape does not fit, or the feature is an orientation by a quaternion.)";

inline constexpr char step[] = R"(Finds the motion from the measured state on.

Path and multipliers of the last call are moved on by dt. Not converging is a status: the motion that was found so far
stands, and the result says how good it is.

Args:
    q: Measured, shape (n,), rad or m.
    velocity: Measured dq/dt, shape (n,), rad/s or m/s.
    dt: Since the last call, s; None: one slice. The first call counts none.
Returns:
    A MpcResult.
Raises:
    ArgumentError: Numbers that do not fit or are not finite; nothing has changed then.)";

inline constexpr char at[] =
    R"(The motion that the last call found, a cubic cancellation slices. After its end it rests there.

Args:
    time: After the last call, s.
Returns:
    q and dq/dt, shape (n,) each.)";

}  // namespace kinegraph::python::docs::mpc
