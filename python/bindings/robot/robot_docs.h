#pragma once

/// The docstrings of bind_bot_op.cpp.
namespace kinegraph::python::docs::robot {

inline constexpr char BotOp[] =
    R"(Moves a simulated or real robot along motions, operates its grippers, and shows both.

Time is virtual unless the robot is real or `realtime` is set. It advances in calls that wait (sync, wait, home, stop),
by exactly their duration, as fast as the computation allows, or at the pace of the wall clock while a browser shows the
configuration. A repeated query (get_t, getTimeToEnd, gripperDone, ...) at the same time advances the clock by one
control period, so that polling loops terminate. The same script gives the same motion, to the bit.

Ctrl-C holds the robot, then raises. A motion beyond a limit of the robot raises an error that names the limit and a
remedy.)";

inline constexpr char BotOp_make[] =
    R"(Simulates a robot in a copy of a configuration, or moves a robot through a driver.

Parameters of params_add: botsim/tau, the control period in s (.01); botsim/hyperSpeed, control time per wall-clock time
while a browser shows the configuration or with realtime, no limit if it is not positive (1); botsim/realtime (False);
botsim/engine, 'physx' (our dynamic engine) or 'kinematic'; bot/blockRealRobot, True to simulate always (False).

Args:
    C: The scene; copied. Its joints are those of the robot.
    useRealRobot: The driver moves a real robot, in real time.
    auto_launch: Ignored; scripts of the reference package pass it.
    driver: A RobotDriver; None for a simulated robot.
    realtime: A thread moves the robot in wall-clock time.
    strict: A joint that comes .3 rad or m from its command stops the robot (RobotFault). False: in simulation it is a
        warning, which takeWarning() returns.
Raises:
    ArgumentError: useRealRobot is set without a driver, or the driver's joints are not those of C.
    RobotFault: The robot reports an error.)";

inline constexpr char get_tauExternal[] =
    R"(Returns the joint forces by contacts, (n,) N m or N: the mean since the last call. NaN if the robot does not
measure them.)";

inline constexpr char getTimeToEnd[] =
    R"(Returns the time until the motion ends, s; 0 or less if it has ended, or if there is none.)";

inline constexpr char moveTo[] = R"(Moves to joint values and rests there. Does not wait.

The motion takes T = (sqrt(6 c d + v^2) - v) / c for a distance d, a velocity v towards the target, and the time cost c;
at least .1 s, and longer if limits of velocity and acceleration require it.

Args:
    q_target: (n,) rad or m.
    timeCost: c; a larger one gives a faster motion.
    overwrite: True replaces the present motion, from the robot's q if the robot is blocked; False appends to it.
Raises:
    ArgumentError: The number of joints is wrong, or a joint value is beyond its limits.
    RobotFault: The robot was stopped, or is not at the start of the motion.)";

inline constexpr char move[] = R"(Moves along a smooth path and rests at its end. Does not wait.

The motion is a spline of degree 3 with these control points: it comes near the inner points and ends at the last. To
execute a plan exactly, use follow(plan).

Args:
    path: (K, n) joint values, rad or m, or (n,) for one point.
    times: (K,) in s after the end of the present motion; or the time of the last point, which the others share evenly.
    overwrite: True replaces the present motion smoothly; times then count from overwriteCtrlTime.
    overwriteCtrlTime: Control time (s) at which the new motion takes over; negative: now. If it has passed, the new
        motion starts at the point that it would have reached by now.
Raises:
    ArgumentError: Sizes do not match, times decrease, or the motion exceeds a limit of position, velocity, acceleration
        or effort; the message names the joint, the time, and the factor on the duration that would do.
    RobotFault: The robot was stopped, or is not at the start of the motion.)";

inline constexpr char moveAutoTimed[] =
    R"(Moves along the points of a path as fast as limits allow, and rests at its end. Does not wait.

The motion is retime's: it follows the lines between the points, and rounds corners by .01 rad or m at most.

Args:
    path: (K, n) joint values, rad or m, or (n,) for one point.
    maxVel: Velocity limit of all joints, rad/s or m/s, in addition to their own.
    maxAcc: Acceleration limit of all joints, rad/s^2 or m/s^2, in addition to their own.
Raises:
    ArgumentError: Sizes do not match, or joint values are beyond limits.
    RobotFault: The robot was stopped, or is not at the start of the motion.)";

inline constexpr char follow[] = R"(Executes a trajectory exactly. Does not wait.

The reference of each control period is motion.eval(t), with velocity and acceleration; nothing is resampled, so that a
verified plan keeps its margin. The trajectory starts at the end of the present motion, or replaces it with overwrite,
and the robot rests at the end. A trajectory that ends with a velocity is followed by a stopping segment. The trajectory
is evaluated in this call.

Args:
    motion: A Trajectory, such as a TimedPath or a motion plan, or a BSpline.
    tolerance: Largest distance of a joint from the trajectory's start, rad or m.
    velocity_tolerance: Largest difference from the trajectory's velocity at its start, rad/s or m/s.
    overwrite: True replaces the present motion instead of following it.
    start_time: Control time of the start with overwrite, s; negative: now.
Raises:
    ArgumentError: The robot is not at the trajectory's start, or the trajectory has another number of dofs, or exceeds
        a limit of position, velocity, acceleration or effort.
    RobotFault: The robot was stopped.)";

inline constexpr char floating[] =
    R"(Sets the stiffness to zero, so that a hand can move the robot. hold() or a motion ends it.

Args:
    damping: Share of the robot's damping that remains, 0 to 1.
Raises:
    ArgumentError: damping is out of range.
    RobotFault: The robot has a fixed stiffness.)";

inline constexpr char setCompliance[] =
    R"(Makes the robot compliant in some directions, until hold() or another compliance.

Args:
    J: (k, n) linearly independent rows of a Jacobian: the directions.
    compliance: 0 (stiff) to 1 (no stiffness).
Raises:
    ArgumentError: The rows are linearly dependent, or have another number of columns.
    RobotFault: The robot has a fixed stiffness.)";

inline constexpr char stepAction[] =
    R"(Accelerates constantly for a short time: one step of a policy. Accelerations and velocities are clipped to their
limits.

From the observation's time and reference, the robot accelerates by a = (delta - 2 xi lmbda qvel) / lmbda^2 for lmbda
seconds. It comes to rest in the next lmbda seconds unless another step follows.

Args:
    delta: (n,) target relative to the present reference, rad or m.
    obs: Result of stepObservation.
    lmbda: Time scale, s.
    maxAccel: Largest entry of a; a is scaled down to it.
    xi: Damping ratio.
Raises:
    ArgumentError: Sizes do not match, or numbers are not positive.
    RobotFault: The robot was stopped.)";

inline constexpr char home[] = R"(Moves to qHome, and waits for the end of the motion.

Args:
    C: Set to the state of robot and world.
Raises:
    RobotFault: The robot was stopped.)";

inline constexpr char stop[] = R"(Stops at once, and waits until the robot rests.

Args:
    C: Set to the state of robot and world.
Raises:
    RobotFault: The robot is in fault.)";

inline constexpr char setLimits[] = R"(Replaces limits of the robot.

Args:
    velocity: (n,) or a number for all joints, rad/s or m/s; empty to keep them.
    acceleration: The same, rad/s^2 or m/s^2.
    effort: The same, N m or N.
Raises:
    ArgumentError: The number of joints is wrong, or a limit is not positive.)";

inline constexpr char sync[] = R"(Advances time, and sets a configuration to the state of robot and world.

Shows the configuration if its viewer is open (C.view()). In real time, a key ends the wait.

Args:
    C: Changed: joint values, grippers, and objects, by name.
    waitTime: s.
    viewMsg: Shown with the control time.
Returns:
    The key pressed in the viewer since the last call, or 0.
Raises:
    ArgumentError: waitTime is negative.
    RobotFault: The robot was stopped; C is set to its state nevertheless.)";

inline constexpr char getGripperTarget[] = R"(Returns the width of the last command to a gripper.

Args:
    id: Number of the gripper, from 0.
Returns:
    The width, m: the smallest one after a command to close, and the initial width before any command.
Raises:
    ArgumentError: There is no such gripper.)";

inline constexpr char watch[] = R"(Calls a function regularly while calls wait: to record, publish, or guard a motion.

The calls come from sync, wait, home, stop, repeated queries, and the execution of plans, in virtual and in real time,
in the thread of the caller. The first one comes with the next wait. Queries inside the function do not advance the
clock, and it cannot wait; it may hold the robot and command motions and grippers. An exception in it holds the robot
and is raised by the waiting call.

Args:
    period: Control time between two calls, s; 0: each control period. A call comes at the first control period that is
        not before its time. In real time a late call is skipped.
    function: Called with the control time, s. It is called no more after it has returned False or raised an exception.
Raises:
    ArgumentError: The period is negative or not finite.)";

inline constexpr char getWorld[] = R"(Returns a copy of the simulated world in its present state.

Returns:
    A Config. For a robot without a simulated world: the scene of the constructor and the frames of later syncs, with
    the robot's q and the openings of its grippers.)";

inline constexpr char wait[] = R"(Syncs until an event occurs.

Args:
    C: As for sync.
    forKeyPressed: Until a key is pressed in the viewer. Without a viewer, it does not wait for keys alone.
    forTimeToEnd: Until the motion ends.
    forGripper: Until all grippers are done.
    syncFrequency: Time between two syncs, s.
Returns:
    The key; ord('g') for grippers; else 0.
Raises:
    RobotFault: The robot was stopped.)";

inline constexpr char gripperMove[] = R"(Opens or closes a gripper. Does not wait.

Args:
    id: Number of the gripper: 0, 1, ... or ArgWord._left, ArgWord._right.
    width: Target width of the opening, m; clipped to the gripper's range, with a KinegraphWarning.
    speed: Speed of the width, m/s, at most the gripper's.
Raises:
    ArgumentError: There is no such gripper, or a number is invalid.)";

inline constexpr char gripperClose[] =
    R"(Closes a gripper until an object stops its fingers, and holds the object. Does not wait.

Args:
    id: Number of the gripper.
    force: N, at most the gripper's.
    width: Width of the object, m, for grippers that use it.
    speed: Speed of the width, m/s.
Raises:
    ArgumentError: There is no such gripper, or a number is invalid.)";

inline constexpr char gripperCloseGrasp[] = R"(Closes a gripper on a named object. Does not wait.

An object that is far from the gripper, and not between its fingers, raises a KinegraphWarning.

Args:
    id: Number of the gripper.
    objName: Frame of the object. With a KinematicDriver, it moves with the gripper from then on.
    force: N, at most the gripper's.
    width: Width of the object, m.
    speed: Speed of the width, m/s.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: There is no such gripper, or a number is invalid.)";

inline constexpr char getGripperPos[] = R"(Returns the width of a gripper's opening.

Args:
    id: Number of the gripper.
Returns:
    The width, m.
Raises:
    ArgumentError: There is no such gripper.)";

inline constexpr char gripperDone[] = R"(Tells whether a gripper has finished its last command.

Args:
    id: Number of the gripper.
Returns:
    True if the gripper has reached its target width, or an object stops its fingers.
Raises:
    ArgumentError: There is no such gripper.)";

inline constexpr char attach[] = R"(Attaches an object to a frame of the simulated world, at its present pose.

Args:
    from_: A frame, such as the gripper.
    to: The object.
Raises:
    FrameNotFound: There is no such frame.
    RobotFault: The robot is not simulated.)";

inline constexpr char detach[] = R"(Detaches an object in the simulated world.

Args:
    from_: The frame that it is attached to.
    to: The object.
Raises:
    FrameNotFound: There is no such frame.
    RobotFault: The robot is not simulated.)";

inline constexpr char getContacts[] =
    R"(Returns the present contacts in the simulated world, as Simulation.getContacts does.

Returns:
    A dict per contact point, in world coordinates: `frames` (two names, "ground" for the plane z = 0), `position` (m),
        `normal` (from
    the first to the second), `distance` (m, negative for an overlap), `force` (N, of the first on the second). Empty
    in a world without forces, and for a real robot.)";

inline constexpr char setFramePose[] = R"(Sets the pose of an object in the simulated world.

Args:
    frame: Name of the object.
    pose: (7,) x y z in m, qw qx qy qz.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: The pose is invalid, or the frame is a joint of the robot or fixed to one.
    RobotFault: The robot is not simulated.)";

inline constexpr char getImageAndDepth[] = R"(Renders the view of a camera in the simulated world.

Args:
    sensorName: Frame of the camera; its attributes describe the camera.
Returns:
    Colors (height, width, 3), 0..255, and depth (height, width) in m, -1 without a surface.
Raises:
    FrameNotFound: There is no such frame.
    FileError: This machine cannot render.)";

inline constexpr char getImage[] = R"(Renders the colors of a camera's view in the simulated world.

Args:
    sensorName: Frame of the camera; its attributes describe the camera.
Returns:
    (height, width, 3), 0..255.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char getImageDepthPcl[] =
    R"(Renders the view of a camera in the simulated world, and computes its point cloud.

Args:
    sensorName: Frame of the camera; its attributes describe the camera.
    globalCoordinates: True gives points in world coordinates, False in those of the camera.
Returns:
    Colors (height, width, 3), depth (height, width) in m, points (height, width, 3) in m.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char getCameraFxycxy[] = R"(Returns the intrinsic parameters of a camera.

Args:
    sensorName: Frame of the camera.
Returns:
    fx, fy, cx, cy in pixels, shape (4,).
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char CommandLog[] =
    R"(All commands to a robot with their control periods. From the same start, the same log gives the same motion, to
the bit.)";

inline constexpr char saveLog[] = R"(Writes the log into a file.

Args:
    path: Path of the file.
Raises:
    FileError: The file cannot be written.)";

inline constexpr char loadLog[] = R"(Reads a log from a file.

Args:
    path: Path of the file.
Returns:
    The log.
Raises:
    FileError: The file cannot be read.
    ParseError: The file is not a log; the message names the line.)";

inline constexpr char logFromText[] = R"(Reads a log from a result of text().

Args:
    text: The text.
Returns:
    The log.
Raises:
    ParseError: The text is not a log; the message names the line.)";

inline constexpr char replay[] = R"(Executes the commands of a log, in virtual time, on a new BotOp.

Args:
    log: Result of getLog().
Raises:
    ArgumentError: The robot has moved before, or the log has another period.
    FrameNotFound: The scene lacks a frame of the log.)";

inline constexpr char recordTo[] = R"(Records the robot into a file from now on, while calls wait.

A name that ends in .mcap gets messages of ROS 2 for Foxglove, Rerun and rosbag2, with the extra `mcap`: joint states,
references, poses, clock, images (docs/mcap.md). Any other file gets a line of numbers per control period: time, q,
velocity, and the references of both.

Args:
    path: Path of the file, which is replaced; empty ends the recording, as close() does.
    rate: Samples per second, Hz. This and the following are for .mcap.
    cameras: Camera frames whose images are recorded as JPEG.
    camera_rate: Images per second, Hz.
    start: Unix time of control time 0, s. All stamps are control times plus this.
Raises:
    FileError: The file cannot be written.
    ArgumentError: A rate or start is invalid.
    FrameNotFound: There is no such camera.
    NotFound: The packages of the extra `mcap` are not installed.)";

}  // namespace kinegraph::python::docs::robot
