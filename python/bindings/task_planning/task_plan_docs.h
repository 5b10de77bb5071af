#pragma once

/// Docstrings of bind_task_plan.cpp and bind_task_execution.cpp.
namespace kinegraph::python::docs::task_plan {

inline constexpr char type[] =
    R"(The result of planTask: actions with their timed motion, or the causes for which there is none.

As a trajectory, the plan is piecewise linear in time between the rows of `path`. Its velocity is constant between two
rows and 0 before the start and after the end; its acceleration is 0. Grippers take no time. Plans can be copied and
pickled: a copy can be played, checked and repaired.)";

inline constexpr char make[] =
    R"(Makes a plan from a motion of your own, for checkTaskPlan. Plans of planTask have scenes and a goal, too.

Args:
    actions: Actions, each a list of words.
    path: Shape (T, n), rad or m.
    times: Shape (T,), s.
    segments: The rows of path of each action, a slice each.
    limits: Velocity and acceleration limits, shape (2, n); None: not checked.
    goal: Literals that shall hold, as those of TaskPlan.goal.
    start: Literals that hold initially, as those of TaskPlan.start. They name hands and objects: without them, carried
        objects are not checked.
Raises:
    ArgumentError: The path is empty, the number of times differs from that of rows, or a segment has a step.
    ParseError: A literal is invalid.)";

inline constexpr char view[] =
    R"(Plays the plan on the page of a scene, with a time slider. Without a motion, the page shows the reason, the
search tree and, in red, the waypoint that failed in the longest branch, if one did.

Args:
    C: The scene of the call to planTask; it does not change.
    pause: Waits for a key.
Returns:
    The key that was pressed, 0 if none.)";

inline constexpr char play[] =
    R"(Shows the motion of each action in the viewer of a scene, with held objects moving along.

Args:
    C: The scene; it ends in its final configuration.
    pause: Waits for a key before each action.
Raises:
    ArgumentError: There is no motion.)";

inline constexpr char frames[] =
    R"(Returns the poses of all frames at equal time steps, as for saveFilm(file, C, plan.frames(C), plan.duration).

Args:
    C: The scene of the call to planTask; it is not changed.
    rate: Steps per second, Hz.
Returns:
    Poses, shape (T, frames, 7).
Raises:
    ArgumentError: There is no motion, or rate is not positive.)";

inline constexpr char failedConfiguration[] =
    R"(Returns a copy of a scene with a translucent red copy of the waypoint that failed in the longest branch.

Args:
    C: The scene of the call to planTask.
Returns:
    The copy.
Raises:
    ArgumentError: No branch failed at a waypoint.)";

inline constexpr char repair[] =
    R"(Plans the remaining actions to the same goal, with the same options, after an execution stopped.

Args:
    C: The current scene, as of TaskExecution.C. Held objects are attached to the hand, and objects that stand on
        something to that. Fingers open for the object that comes next.
    time_limit: s of wall time; None: that of the plan.
    max_evaluations: Budget of evaluations; None: that of the plan.
    threads: Threads; None: those of the plan.
    also: Further literals of the goal, such as (up z cup). Those of `up` are left out if the domain has no such word.
Returns:
    A TaskPlan; not finding one is a status.
Raises:
    ArgumentError: The plan was not made by planTask.)";

}  // namespace kinegraph::python::docs::task_plan
