#pragma once

namespace kinegraph::python::docs::task_plays {

inline constexpr char execution[] = R"(How far a robot came with a plan; TaskPlan.execute makes it.)";

inline constexpr char executeTask[] =
    R"(Moves a robot along a plan of a task; see TaskPlan.execute.

Args:
    plan: What planTask found.
    bot: A BotOp whose world is the scene of the plan.
Returns:
    How far it came, and why it stopped.
Raises:
    ArgumentError: There is no motion, or the robot cannot begin it.
    RobotFault: The robot was stopped.
)";

inline constexpr char frames[] =
    R"(Where all frames are along a plan of a task; see TaskPlan.frames.

Args:
    plan: What planTask found.
    C: The scene that was planned in; it is not changed.
    rate: Steps per second.
Returns:
    Poses, shape (T, frames, 7).
Raises:
    ArgumentError: There is no motion.
)";

inline constexpr char failedConfiguration[] =
    R"(A copy of the scene in which the waypoint that the farthest branch of a search failed at stands as a red ghost.

Args:
    plan: What planTask answered.
    C: The scene that was planned in.
Returns:
    The copy.
Raises:
    ArgumentError: No branch failed at a waypoint.
)";

inline constexpr char show[] =
    R"(Brings a scene to where the scene of an action is, with what is held.

Args:
    C: The scene that is changed.
    scene: That of the action, with what is held attached; it is brought to q as well.
    q: Joint values, shape (n,), rad or m.
Returns:
    Nothing.
Raises:
    ArgumentError: The scenes have other joints.
)";

}  // namespace kinegraph::python::docs::task_plays
