#pragma once

namespace kinegraph::python::docs::plan {

inline constexpr char constraint[] =
    R"(A condition on postures, for planMotion: scale * (feature - target) is zero, or not positive.

    upright = ry.MotionConstraint(ry.FS.vectorZ, ["glass"], target=[0, 0, 1]))";

inline constexpr char makeConstraint[] =
    R"(Names the feature and its frames; they are looked up when a motion is planned.

Args:
    feature: A symbol of FS, or a function of frames.
    frames: A frame's name, or several.
    type: OT.eq: zero; OT.ineq: not positive.
    scale: A number, one per row, or a matrix.
    target: A number, or one per row.
Raises:
    ArgumentError: The type is neither eq nor ineq; told by planMotion.
    FrameNotFound: A frame is not in the scene; told by planMotion.)";

inline constexpr char planMotion[] = R"(A motion to a goal, free of collisions at all times, and when it is where.

    plan = ry.planMotion(C, {"gripper": [.4, .2, .9]}, margin=.01)
    if plan.feasible: C.view_path(plan.path, plan.duration)
    else: print(plan.message)

The straight motion is tried first, then trees grow from both ends; what is found is shortened, pulled taut, verified at all
times, and timed. The scene is not changed. The same arguments give the same bits at any number of threads, unless time_limit ends it.
Ctrl-C ends it.

Args:
    config: The scene; obstacles are what collides there, and what is attached to the robot moves with it.
    goal: A joint vector (n,), several (N, n) of which one is to be reached, a dict of targets as for solveIk, the name of a
        joint state (C.getStateNames), or a MotionConstraint or several that are to hold.
    start: A joint vector (n,), rad or m; None: the present q.
    fields: Options by name; and velocity, acceleration, jerk: limits, a number or one per joint (rad or m, s), by default
        the model's velocities (1 where it says none), reached in a quarter of a second, and no limit of the jerk;
        constraints: MotionConstraints that hold all along;
        start_velocity: dq/dt with which the motion begins, shape (n,), rad/s or m/s, by default at rest;
        start_acceleration: d2q/dt2 likewise, with limits of the jerk; by default none;
        moving: what moves by itself meanwhile, a dict of frame -> (times, values): times of shape (K,), s from the begin of
        the motion; values of shape (K, 7), poses of the frame in the world, or (K, d), positions of its joint, which is no
        part of q. Between them it goes straight, before and after them it stands still. The motion keeps clear of it at
        all times, waits where it has to, and can stay where it ends.
)";

inline constexpr char planMotionRest[] = R"(Returns:
    A MotionPlan. Where there is no motion, its message says why.
Raises:
    ArgumentError: The goal or an option makes no sense; a joint without limits would have to be drawn.
    FrameNotFound: A frame is not in the scene.
    NotFound: The scene knows no joint state of that name.)";

inline constexpr char planMotions[] =
    R"(Motions that get better while one waits: the first is that of planMotion, each further one takes less time than the one
before, or with optimize="length" is shorter.

    for plan in ry.planMotions(C, goal, margin=.01, improve=200000):
        print(plan.duration)

Further ways are searched, always with other random numbers, where a shorter one can be. The same arguments give the same
motions at any number of threads, unless time_limit ends it. Ctrl-C ends it.

Args:
    config: As for planMotion.
    goal: As for planMotion.
    start: A joint vector (n,), rad or m; None: the present q.
    fields: As for planMotion, without moving, start_velocity and start_acceleration. improve: evaluations that are spent on better motions, 1000000
        by default; time_limit: s, from the first motion on.
Returns:
    An iterator of MotionPlans. Where there is no motion, it gives one that says why.
Raises:
    ArgumentError: The goal or an option makes no sense; a joint without limits would have to be drawn.
    FrameNotFound: A frame is not in the scene; told with the first motion.
    NotFound: The scene knows no joint state of that name; told with the first motion.)";

inline constexpr char type[] = R"(What planMotion found. It can be copied and pickled, as to send it from one process to
another; its scene as it was then goes along.)";

inline constexpr char at[] = R"(Where the motion is at a time, and how it moves.

Args:
    t: s, held within 0 and duration.
Returns:
    q (n,), rad or m, its velocity and its acceleration.
Raises:
    ArgumentError: There is no motion.)";

inline constexpr char obstaclesAt[] = R"(Where the obstacles are that move while the robot does.

Args:
    t: s.
Returns:
    A dict of frame -> its pose in the world (7,), x y z qw qx qy qz, or the positions of its joint (d,).)";

inline constexpr char replan[] =
    R"(A motion that goes on from where this one is at a time, and as fast as it is there, so that a robot which is on its way
need not stop. The time of the new motion begins at 0 then.

    bend = plan.replan(C, at=1.2, goal=[.4, .2, .9])

Where the rest of this motion leads to the goal and is still free, it stays. With limits of the jerk, the new motion has the
acceleration of this one at first, too, but among moving obstacles.

Args:
    config: The scene, which may have changed.
    at: When, s, held within 0 and duration.
    goal: As for planMotion; None: where this motion ends.
    fields: Options that differ from those of this motion. Times of moving obstacles count from the begin of the new motion;
        those of this motion are taken over such that they do.
Returns:
    A MotionPlan. Where there is no motion, its message says why, as that it cannot come to rest in time.
Raises:
    ArgumentError: There is no motion to go on from; the goal or an option makes no sense.
    FrameNotFound: A frame is not in the scene.)";

inline constexpr char clearance[] =
    R"(The least distance of a collidable pair along the path, to 0.1 mm. Moving obstacles do not count.

Args:
    most: What counts as far, m.
Returns:
    m; most where all pairs are farther apart at all times.
Raises:
    ArgumentError: There is no motion.)";

inline constexpr char picture[] =
    R"(A copy of the scene with lines in it along which frames went: "start tree" (blue) and "goal tree" (orange), "first way"
(gray), and the "path" (green) that came of it. Where there is none, the obstacle that most motions ended at is red.

Args:
    config: The scene that was planned in.
)";

inline constexpr char view[] = R"(Shows the picture, and plays the motion in it.

Args:
    config: The scene that was planned in.
)";

inline constexpr char viewRest[] = R"(    pause: Waits for a key.
Returns:
    The key that was pressed, 0 if none.
)";

inline constexpr char shortcut[] = R"(A shorter path cancellation the same ends, free at all times.

Args:
    config: The scene.
    path: Postures, shape (K, n), rad or m, whose straight motions are free.
    margin: Distance that all collidable pairs keep, m.
    seed: Of the places that are joined.
Returns:
    The path, shape (L, n).
Raises:
    ArgumentError: The path has another shape, or is not free; the message says where.)";

inline constexpr char smooth[] = R"(The same path with rounded corners, as far as that is free at all times.

Args:
    config: The scene.
    path: Postures, shape (K, n), rad or m, whose straight motions are free.
    margin: Distance that all collidable pairs keep, m.
    blend: By how much corners may be missed, in every dof, rad or m.
Returns:
    Postures along it, shape (L, n).
Raises:
    ArgumentError: The path has another shape, or is not free; the message says where.)";

}  // namespace kinegraph::python::docs::plan
