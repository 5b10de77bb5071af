#pragma once

/// The manual of what bind_diff_ik.cpp binds.
namespace kinegraph::python::docs::diff_ik {

inline constexpr char make[] =
    R"(Creates a controller of a scene. Each step reads and moves this scene; its current q is the posture.

Args:
    config: The scene. It is shared: targets and obstacles may move between steps.
    velocity: Limits of |dq/dt|, one number or shape (n,), rad/s or m/s; None: those of C.getVelocityLimits.
    acceleration: Limits of |d2q/dt2|, one number or shape (n,), rad/s^2 or m/s^2; None: none.
    posture: Cost per rad or m of distance from the posture, beside the weights of tasks.
    damping: Cost of the squared step.
    collisions: True keeps collidable pairs apart whose distance depends on joints.
    margin: Least distance of these pairs, m.
    collision_gain: Share of the distance beyond the margin that one step may use up, in (0, 1].
    influence_distance: Pairs farther apart than this have no constraint, m.
Raises:
    ArgumentError: A limit or option is not positive, or the limits have another size.)";

inline constexpr char addTask[] = R"(Adds a feature that shall become zero, or its target.

Args:
    feature: A symbol of FS, or a function of frames, as for C.eval.
    frames: Name of the frame of the feature, or names of its frames.
    weight: Multiplies the components of the feature, beside other tasks and the posture.
    gain: Share of the error that one step removes, in (0, 1].
    target: Target of the feature, one number or one per component; None: zero.
    priority: Tasks with a higher number only use directions that lower numbers leave free; the posture comes last.
Returns:
    Index of the task, for setTarget.
Raises:
    ArgumentError: The frames do not fit the feature, it needs several configurations, or gain is out of range.
    FrameNotFound: A frame is not in the scene.)";

inline constexpr char addEquality[] = R"(Adds a feature that must become zero, or its target, before all tasks.

Limits and distances still hold. If they forbid the equality, it is relaxed as little as possible, and message reports
it.

Args:
    feature: A symbol of FS, or a function of frames, as for C.eval.
    frames: Name of the frame of the feature, or names of its frames.
    gain: Share of the error that one step removes, in (0, 1].
    target: Target of the feature, one number or one per component; None: zero.
Returns:
    Index of the task, for setTarget.
Raises:
    ArgumentError: The frames do not fit the feature, it needs several configurations, or gain is out of range.
    FrameNotFound: A frame is not in the scene.)";

inline constexpr char setTarget[] = R"(Sets the target of a task or equality.

Args:
    task: Index of the task, from addTask.
    target: One number, or one per component.
Raises:
    ArgumentError: There is no such task, or the target has another size.)";

inline constexpr char setPosture[] = R"(Sets the configuration that the nullspace of the tasks moves to.

Args:
    q: Shape (n,), rad or m.
Raises:
    ArgumentError: q has another size.)";

inline constexpr char step[] = R"(Computes the velocity for the next dt seconds, and moves the scene by it.

Limits never raise an error: from beyond a limit the joint returns as fast as velocities allow. Distances that cannot
hold are relaxed as little as possible; status is then constraints_relaxed, and message names them.

Args:
    dt: Length of the step, s.
    apply: False does not move the scene.
Returns:
    dq/dt, shape (n,), rad/s or m/s.
Raises:
    ArgumentError: dt is not positive.)";

}  // namespace kinegraph::python::docs::diff_ik
