#pragma once

/// The docstrings of bind_plan.cpp. plan_arguments.cpp adds the entries of options.
namespace kinegraph::python::docs::plan {

inline constexpr char constraint[] =
    R"(A constraint on configurations, for planMotion: scale * (feature - target) is zero, or not positive.

    upright = ry.MotionConstraint(ry.FS.vectorZ, ["glass"], target=[0, 0, 1]))";

inline constexpr char makeConstraint[] =
    R"(Names the feature and its frames, which are looked up when a motion is planned.

Args:
    feature: A symbol of FS, or a function of frames.
    frames: A frame's name, or several.
    type: OT.eq: zero; OT.ineq: not positive.
    scale: A number, one per row, or a matrix.
    target: A number, or one per row.
Raises:
    ArgumentError: The type is neither eq nor ineq; raised by planMotion.
    FrameNotFound: A frame is not in the scene; raised by planMotion.)";

inline constexpr char planMotion[] = R"(Plans a collision-free, time-parameterized motion to a goal.

    plan = ry.planMotion(C, {"gripper": [.4, .2, .9]}, margin=.01)
    if plan.feasible: C.view_path(plan.path, plan.duration)
    else: print(plan.message)

The planner tries the straight motion first, then RRT-Connect. It shortens and tightens the path, verifies every edge
continuously, and computes the fastest motion within the limits. The scene is not changed. Equal arguments give equal
bits at any number of threads, unless time_limit ends a stage. Ctrl-C ends the call.

Args:
    config: The scene. Its collidable pairs count, and objects attached to the robot move with it.
    goal: A joint vector (n,); several (N, n), one of which is reached; a dict of targets as for solveIk; the name of
        a joint state (C.getStateNames); or one or several MotionConstraints.
    start: A joint vector (n,), rad or m. None: the present q.
)";

inline constexpr char planMotionRest[] = R"(Returns:
    A MotionPlan. If there is no motion, its message says why.
Raises:
    ArgumentError: The goal or an option is invalid, or a joint without limits would have to be sampled.
    FrameNotFound: A frame is not in the scene.
    NotFound: The scene has no joint state of that name.)";

inline constexpr char planMotions[] =
    R"(Plans a sequence of improving motions. The first is that of planMotion; each further one takes less time than
the one before, or with optimize="length" is shorter.

    for plan in ry.planMotions(C, goal, margin=.01, improvement_evaluations=200000):
        print(plan.duration)

Further searches use other random numbers, and sample only the part of the space that can contain a shorter path.
Equal arguments give equal motions at any number of threads, unless time_limit, counted from the first motion, ends
the sequence. Ctrl-C ends it.

Args:
    config: The scene, as for planMotion.
    goal: The goal, as for planMotion.
    start: A joint vector (n,), rad or m. None: the present q.
)";

inline constexpr char planMotionsRest[] = R"(Returns:
    An iterator of MotionPlans. If there is no motion, it yields one plan whose message says why.
Raises:
    ArgumentError: The goal or an option is invalid, or a joint without limits would have to be sampled.
    FrameNotFound: A frame is not in the scene; raised with the first motion.
    NotFound: The scene has no joint state of that name; raised with the first motion.)";

inline constexpr char type[] =
    R"(The motion that planMotion found, a Trajectory, or the reason why there is none. It can be
copied and pickled, for example to send it to another process; a copy of its scene is included.)";

inline constexpr char obstaclesAt[] = R"(Returns the values of the dynamic obstacles at a time.

Args:
    t: s.
Returns:
    A dict of frame -> its pose in the world (7,), x y z qw qx qy qz, or the positions of its joint (d,).)";

inline constexpr char replan[] =
    R"(Plans a motion that continues this one from a time on, with its velocity at that time, so that a moving robot
need not stop. Time 0 of the new motion is `at` of this one.

    next_plan = plan.replan(C, at=1.2, goal=[.4, .2, .9])

If the rest of this motion leads to the goal and is still collision-free, it stays. With jerk limits, the new motion
also continues the acceleration of this one. Options that are None stay as in this motion, with the times of its
dynamic obstacles shifted to the new one; obstacle_trajectories={} drops the obstacles.

Args:
    config: The scene, which may have changed.
    at: Time of this motion, s; clamped to 0 and duration.
    goal: The goal, as for planMotion. None: the end of this motion.
)";

inline constexpr char replanRest[] =
    R"(Returns:
    A MotionPlan. If there is no motion, its message says why, for example that the robot cannot stop in time.
Raises:
    ArgumentError: There is no motion to continue, or the goal or an option is invalid.
    FrameNotFound: A frame is not in the scene.)";

inline constexpr char clearance[] =
    R"(Computes the least distance of a collidable pair along the path, to 0.1 mm. Dynamic obstacles do not count.

Args:
    max_distance: Largest distance that is computed, m.
Returns:
    m; max_distance if no pair is closer.
Raises:
    ArgumentError: There is no motion.)";

inline constexpr char picture[] =
    R"(Returns a copy of the scene with the traces of frames as lines: "start tree" (blue) and "goal tree" (orange),
"raw path" (gray), and "path" (green). If there is no motion, the most frequent obstacle is red.

Args:
    config: The scene of the plan.
)";

inline constexpr char view[] =
    R"(Shows the picture on the page of the scene, until its next view(), and plays the motion there.

Args:
    config: The scene of the plan.
)";

inline constexpr char viewRest[] = R"(    pause: Waits for a key.
Returns:
    The key that was pressed, 0 if none.
)";

inline constexpr char shortcut[] = R"(Shortens a path between the same ends. The result is continuously
collision-free.

Args:
    config: The scene.
    path: Configurations, shape (K, n), rad or m, connected by collision-free straight edges.
    margin: Distance that all collidable pairs keep, m.
    seed: Seed of the random shortcuts.
Returns:
    The path, shape (L, n).
Raises:
    ArgumentError: The path has another width, or is in collision; the message says between which rows.)";

inline constexpr char smooth[] = R"(Rounds the corners of a path as far as that is continuously collision-free.

Args:
    config: The scene.
    path: Configurations, shape (K, n), rad or m, connected by collision-free straight edges.
    margin: Distance that all collidable pairs keep, m.
    blend: Largest deviation from the path in every dof, rad or m.
Returns:
    Configurations along the smoothed path, shape (L, n).
Raises:
    ArgumentError: The path has another width, or is in collision; the message says between which rows.)";

}  // namespace kinegraph::python::docs::plan
