#pragma once

namespace kinegraph::python::docs::task_execution {

inline constexpr char execute[] =
    R"(Executes the plan on a robot, action by action. The robot first moves to the start of the plan, collision-free.
It then follows the plan exactly. Hands close and open. Before and after each motion and grip, the world is compared
with the plan: held objects have to be in the hand and pressed by its fingers, all others at their places, and the arm
in its configuration. After a deviation the robot stops, opens hands that have lost their objects, backs out of
collisions, and plans again from there.

Args:
    bot: A BotOp whose world is the scene of the plan. Objects that actions move need a mass there.
    repairs: New plans, at most, if the world deviates; 0 stops at the first deviation.
    observe: Returns the poses of objects, as cameras see them: name -> (x, y, z, qw, qx, qy, qz) in m, or None for an
        object that was not seen. Objects without a pose are taken to be where they were, or in the hand that holds
        them. A SceneObserver does this, and its map becomes an obstacle: the robot stops before a motion that would
        enter its cells. With cameras, the execution knows the scene of the plan, and not the simulated world. None: the
        poses of the simulated world.
    callback: Called with a TaskEvent after each step; returning False ends the execution.
    max_external_effort: Torque (N m) or force (N) of contacts at a joint above which a motion stops, a number or one
        per dof; None: no limit.
    time_limit: s of wall time for each new plan; None: as for planTask.
    max_evaluations: Budget of each new plan; None: as for planTask.
    threads: Threads for each new plan; None: as for planTask.
Returns:
    A TaskExecution: whether the goal holds, how many actions were executed, the reason for stopping, and the final
    scene. Deviations, faults of the robot and missing plans are results, not exceptions.
Raises:
    ArgumentError: There is no motion, `bot` is no BotOp, an object that actions move has no mass, a motor moves a door,
        or an argument is invalid.)";

inline constexpr char run[] =
    R"(Executes the plan on a robot step by step, as `execute` does. Between two steps the robot rests, and a program
may look, disturb the world, or stop:

    run = plan.run(bot)
    for event in run:
        print(event)
    print(run.result)

Args:
    bot: A BotOp whose world is the scene of the plan. Objects that actions move need a mass there.
    repairs: New plans, at most, if the world deviates.
    observe: A SceneObserver, or a function that returns the poses of objects, name -> pose or None; see `execute`.
    max_external_effort: Torque (N m) or force (N) of contacts at a joint above which a motion stops; None: no limit.
    time_limit: s of wall time for each new plan; None: as for planTask.
    max_evaluations: Budget of each new plan; None: as for planTask.
    threads: Threads for each new plan; None: as for planTask.
Returns:
    A TaskRun, an iterator of TaskEvents.
Raises:
    ArgumentError: As for `execute`.)";

inline constexpr char run_type[] =
    R"(An execution step by step; TaskPlan.run makes it. It iterates over TaskEvents; the robot moves in between.)";

inline constexpr char result[] = R"(The result of TaskPlan.execute and TaskPlan.run.)";

inline constexpr char kind[] =
    R"(What a TaskEvent reports. start: the robot is where the plan begins. motion: the motion of an action is done.
grip: hands have closed or opened, an action is done. failure: the world deviates from the plan, and the robot has
stopped. repair: there is a new plan. end: the goal is reached, or the execution was given up.)";

}  // namespace kinegraph::python::docs::task_execution
