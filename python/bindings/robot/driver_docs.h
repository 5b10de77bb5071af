#pragma once

/// The docstrings of bind_robot_driver.cpp.
namespace kinegraph::python::docs::robot {

inline constexpr char RobotDriver[] =
    R"(The interface of BotOp to a robot. Subclasses drive your own robots.

A subclass defines info, read, write and stop, and if needed connect, disconnect, recover, moveGripper, and, for
simulated robots, step. Calls come from one thread at a time. An exception stops the robot, and BotOp raises it as a
RobotFault.)";

inline constexpr char write[] = R"(Moves the robot.

Args:
    command: Target at the end of the control period, within the robot's limits.)";

inline constexpr char stopRobot[] =
    R"(Brings the robot to rest after a fault. Called once; write is not called again until recover().

Args:
    reason: Cause of the fault.)";

inline constexpr char moveGripper[] = R"(Moves a gripper.

Args:
    command: A GripperCommand.
Raises:
    RobotFault: The robot has no grippers.)";

inline constexpr char step[] = R"(Advances a simulation. Drivers of real robots do nothing.

Args:
    period: s.)";

inline constexpr char GripperInfo[] = R"(Describes a gripper.

Args:
    name: Name of the gripper.
    min_width, max_width: Range of the opening, m.
    max_speed: Largest speed of the width, m/s.
    max_force: Largest force, N.)";

inline constexpr char GripperState[] = R"(Sets the state of a gripper.

Args:
    width: Width of the opening, m.
    is_done: The gripper has reached its target width, or an object stops it.)";

inline constexpr char RobotInfo[] = R"(Describes a robot. Limits that are left out are infinite.

Args:
    name: Name of the robot, for messages.
    joints: One name per entry of q, in the order of Config.getJointNames.
    lower, upper: (n,) limits of q, rad or m.
    velocity, acceleration: (n,) limits, rad/s and rad/s^2, or with m.
    effort: (n,) limits, N m or N.
    rate: Preferred rate of commands, Hz.
    compliant: The robot supports a reduced stiffness.
    grippers: A list of GripperInfo.
Raises:
    ArgumentError: Sizes do not match, or limits are not positive.)";

inline constexpr char RobotInfo_of[] =
    R"(Describes the joints of a scene with their limits; accelerations are not limited.

Args:
    config: The scene.
    name: Name of the robot.
Returns:
    The info, without grippers.)";

inline constexpr char RobotState[] = R"(Sets the state of a robot.

Args:
    time: Robot's clock, s. If it stands still, the robot is stopped.
    q: (n,) rad or m.
    velocity: (n,) rad/s or m/s.
    effort: (n,) of the motors, N m or N; empty if unknown.
    external_effort: (n,) by contacts, N m or N; empty if unknown.
    grippers: A list of GripperState.
    error: Error that the robot reports; empty without one.
Raises:
    ArgumentError: An argument is not a number.)";

inline constexpr char KinematicDriver[] =
    R"(A robot that follows its commands exactly, in a world without forces and contacts.)";

inline constexpr char KinematicDriver_make[] = R"(Copies a scene as the world.

Args:
    config: The scene.)";

inline constexpr char SimulatedDriver[] =
    R"(A robot in a simulated world with masses, contacts and friction. A gripper holds objects by force.)";

inline constexpr char SimulatedDriver_make[] = R"(Copies a scene as the world.

Args:
    config: The scene.
    options: A SimulationOptions.
Raises:
    ArgumentError: The scene cannot be simulated; the message gives the cause.)";

inline constexpr char RecordedDriver[] = R"(A robot that returns given states and records its commands, for tests.)";

inline constexpr char RecordedDriver_make[] = R"(Takes the states that read() returns.

Args:
    info: A RobotInfo.
    states: States in order; the last one repeats. If empty, the robot follows its commands exactly.
    start: (n,) first q, without states.
Raises:
    ArgumentError: There are neither states nor a start.)";

}  // namespace kinegraph::python::docs::robot
