#pragma once

/// The manual of what bind_diff_ik.cpp binds.
namespace kinegraph::python::docs::diff_ik {

inline constexpr char make[] =
    R"(For a scene, which it moves and looks at anew in each step; its posture is the one to stay near.

Args:
    config: The scene. It is shared: targets and obstacles may move cancellation steps.
    velocity: Limits of |dq/dt|, one number or shape (n,), rad/s or m/s; None: the model's, as C.getVelocityLimits.
    acceleration: Limits of |d2q/dt2|, one number or shape (n,), rad/s^2 or m/s^2; None: none.
    posture: Cost per rad or m from the posture, beside the weights of tasks.
    damping: Cost of the square of a step.
    collisions: Keeps the collidable pairs apart that joints move.
    margin: Least distance of these pairs, m.
    collision_gain: Share of the distance beyond the margin that one step may use up, in (0, 1].
    range: Pairs farther apart than this are not looked at, m.
Raises:
    ArgumentError: A limit or option that is not positive, or limits of another size.)";

inline constexpr char addTask[] = R"(A feature that is to become zero, or its target.

Args:
    feature: A symbol of FS, or a function of frames, as for C.eval.
    frames: Name of the feature's frame, or names of its frames.
    weight: Multiplies its rows, beside other tasks and the posture.
    gain: Share of the error that one step takes away, in (0, 1].
    target: What it is to become, one number or one per row; None: zero.
    priority: Tasks of a higher priority number have what those of lower ones leave open; the posture comes last.
Returns:
    Number of the task, for setTarget.
Raises:
    ArgumentError: The frames do not fit the feature, it needs several configurations, or gain is out of range.
    FrameNotFound: A frame that is not in the scene.)";

inline constexpr char addEquality[] = R"(A feature that must become zero, or its target, before all tasks.

Limits and distances are kept all the same: where they forbid it, it gives way as little as possible, and message says so.

Args:
    feature: A symbol of FS, or a function of frames, as for C.eval.
    frames: Name of the feature's frame, or names of its frames.
    gain: Share of the error that one step takes away, in (0, 1].
    target: What it is to become, one number or one per row; None: zero.
Returns:
    Number of the task, for setTarget.
Raises:
    ArgumentError: The frames do not fit the feature, it needs several configurations, or gain is out of range.
    FrameNotFound: A frame that is not in the scene.)";

inline constexpr char setTarget[] = R"(Changes what the feature of a task is to become.

Args:
    task: Its number, from addTask.
    target: One number, or one per row.
Raises:
    ArgumentError: There is no such task, or the target has another size.)";

inline constexpr char setPosture[] = R"(Changes the posture to stay near.

Args:
    q: Shape (n,), rad or m.
Raises:
    ArgumentError: q has another size.)";

inline constexpr char step[] = R"(Computes the velocity for the next dt seconds, and moves the scene by it.

Limits and contradictions raise no error: from beyond a limit it goes back as fast as velocities allow, and distances that
cannot be kept give way as little as possible; then status is constraints_relaxed, and message says which.

Args:
    dt: Length of the step, s.
    apply: False leaves the scene as it is.
Returns:
    dq/dt, shape (n,), rad/s or m/s.
Raises:
    ArgumentError: dt is not positive.)";

}  // namespace kinegraph::python::docs::diff_ik
