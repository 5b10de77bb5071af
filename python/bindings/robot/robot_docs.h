#pragma once

/// The manual of what bind_bot_op.cpp and bind_robot_driver.cpp bind.
namespace kinegraph::python::docs::operation {

inline constexpr char BotOp[] =
    R"(Moves a robot, simulated or there, along motions; opens and closes its grippers; shows how it goes.

Time is virtual unless a robot is there or `realtime` is set: it goes on in calls that wait (sync, wait, home, stop) by exactly
what they say, as fast as it can be computed, or as fast as time on the wall while a browser shows the configuration. Who asks
the same question (get_t, getTimeToEnd, gripperDone, ...) again at the same time is answered one period later, so that
loops that ask until a motion is over come to an end. The same script gives the same motion, to the bit.

Ctrl-C holds the robot, then raises. Motions beyond limits of the robot are errors that say which limit, and what would do.)";

inline constexpr char BotOp_make[] = R"(A robot, simulated in a copy of a configuration, or behind a driver.

Parameters that params_add sets: botsim/tau, the period of control, s (.01); botsim/hyperSpeed, seconds of control per second
while somebody watches or with realtime, not positive: as fast as it can (1); botsim/realtime (False); botsim/engine, 'physx' (our
dynamic engine) or 'kinematic'; bot/blockRealRobot, True: always simulated (False).

Args:
    C: The scene; not changed, and not looked at later. Its joints are those of the robot.
    useRealRobot: The robot behind the driver is there: time is real.
    auto_launch: Without meaning; scripts pass it.
    driver: A RobotDriver; None for a simulated robot.
    realtime: A thread moves the robot by the clock on the wall.
Raises:
    ArgumentError: useRealRobot without a driver; a driver whose joints are not those of C.
    RobotFault: The robot reports an error.)";

inline constexpr char get_tauExternal[] =
    R"(Forces at the joints by what the robot touches, (n,) N m or N: the mean since the last call. NaN if it does not know.)";

inline constexpr char getTimeToEnd[] = R"(Seconds until the motion ends; 0 or less: it has, or there is none.)";

inline constexpr char moveTo[] = R"(Goes to joint values and rests there. Does not wait.

It takes T = (sqrt(6 c d + v^2) - v) / c for a distance d, with velocity v towards it and the cost of time c; at least .1 s, and as
long as limits of velocity and acceleration ask for.

Args:
    q_target: (n,) rad or m.
    timeCost: c: the larger, the faster.
    overwrite: Instead of what it does now, from where the robot is if something holds it back; else after that.
Raises:
    ArgumentError: Another number of joints, or joint values beyond limits.
    RobotFault: The robot was stopped, or is not where the motion begins.)";

inline constexpr char move[] = R"(Goes along a smooth path, and rests at its end. Does not wait.

The motion is a spline of degree 3 with these control points: it comes near to inner ones and ends at the last.

Args:
    path: (K, n) joint values, rad or m, or (n,) for one point.
    times: (K,) in s after the end of what it does now; or one time, that of the last point, which the others share evenly.
    overwrite: Instead of what it does now, smoothly; times then count from overwriteCtrlTime.
    overwriteCtrlTime: Control time, s, until which it goes on with what it does; negative: now. From a time that is over, the motion
        is taken up where it would be now.
Raises:
    ArgumentError: Sizes that do not fit, times that fall, or a motion beyond a limit of position, velocity, acceleration or
        effort; the message says of which joint, when, and how much longer it would have to take.
    RobotFault: The robot was stopped, or is not where the motion begins.)";

inline constexpr char moveAutoTimed[] =
    R"(Goes along a smooth path as fast as limits allow, and rests at its end. Does not wait.

Args:
    path: (K, n) joint values, as for move; the times cancellation points are equal.
    maxVel: No joint is faster, rad/s or m/s, nor than its own limit.
    maxAcc: No joint accelerates more, rad/s^2 or m/s^2, nor than its own limit.
Raises:
    ArgumentError: Sizes that do not fit, or joint values beyond limits.
    RobotFault: The robot was stopped, or is not where the motion begins.)";

inline constexpr char follow[] = R"(Follows any spline, in control time, from where the robot is.

Args:
    motion: A BSpline of degree 3 or less.
Raises:
    ArgumentError: It has another number of joints, or breaks a limit.
    RobotFault: The robot was stopped, or is not where the motion is now.)";

inline constexpr char floating[] = R"(Lets go: who pushes the robot moves it. hold() or a motion ends that.

Args:
    damping: Share of the robot's damping that stays, 0 to 1.
Raises:
    ArgumentError: damping is out of range.
    RobotFault: The robot is always stiff.)";

inline constexpr char setCompliance[] = R"(Gives way in some directions, until hold() or another compliance.

Args:
    J: (k, n) rows of a Jacobian, independent of each other: the directions.
    compliance: 0 (stiff) to 1 (gives way fully).
Raises:
    ArgumentError: Rows that depend on each other, or another number of columns.
    RobotFault: The robot is always stiff.)";

inline constexpr char stepAction[] =
    R"(Accelerates constantly for a moment: one step of a policy. Accelerations and velocities beyond limits are cut off.

From the observation's time and reference on it accelerates with a = (delta - 2 xi lmbda qvel) / lmbda^2 for lmbda seconds, and
then comes to rest in as many, unless another step follows.

Args:
    delta: (n,) where to go, relative to where it shall be now, rad or m.
    obs: What stepObservation gave.
    lmbda: Time scale, s.
    maxAccel: The largest entry of a; a is scaled down to it.
    xi: Damping ratio.
Raises:
    ArgumentError: Sizes that do not fit, or numbers that are not positive.
    RobotFault: The robot was stopped.)";

inline constexpr char home[] = R"(Goes to qHome, and waits until it is there.

Args:
    C: Is brought to where robot and world are.
Raises:
    RobotFault: The robot was stopped.)";

inline constexpr char stop[] = R"(Comes to rest at once, and waits for it.

Args:
    C: Is brought to where robot and world are.
Raises:
    RobotFault: The robot was stopped by a guard.)";

inline constexpr char setLimits[] = R"(Sets limits in place of the robot's own.

Args:
    velocity: (n,) or a number for all joints, rad/s or m/s; as they are if empty.
    acceleration: The same, rad/s^2 or m/s^2.
    effort: The same, N m or N.
Raises:
    ArgumentError: Another number of joints, or a limit that is not positive.)";

inline constexpr char sync[] = R"(Lets time go on, and brings a configuration to where robot and world are.

Shows it if its viewer is open (C.view()). Where time is real, a key ends the waiting.

Args:
    C: Is changed: joint values, grippers, and things, by name.
    waitTime: s.
    viewMsg: Shown with control time.
Returns:
    The key pressed in the viewer since the last time, or 0.
Raises:
    ArgumentError: waitTime is negative.
    RobotFault: The robot was stopped; C is where it is all the same.)";

inline constexpr char wait[] = R"(Syncs until something happens.

Args:
    C: As for sync.
    forKeyPressed: Until a key is pressed in the viewer. For this alone it does not wait if nobody watches.
    forTimeToEnd: Until the motion is over.
    forGripper: Until all grippers are done.
    syncFrequency: s cancellation two syncs.
Returns:
    The key; ord('g') for grippers; else 0.
Raises:
    RobotFault: The robot was stopped.)";

inline constexpr char gripperMove[] = R"(Opens or closes a gripper. Does not wait.

Args:
    id: Which one: 0, 1, ... or ArgWord._left, ArgWord._right.
    width: Of the opening, m; as near as the gripper can.
    speed: Of the width, m/s, at most the gripper's.
Raises:
    ArgumentError: There is no such gripper, or a number makes no sense.)";

inline constexpr char gripperClose[] =
    R"(Closes a gripper until something is cancellation its fingers, and holds that. Does not wait.

Args:
    id: Which one.
    force: N, at most the gripper's.
    width: Of the thing, m, for grippers that want to know.
    speed: Of the width, m/s.
Raises:
    ArgumentError: There is no such gripper, or a number makes no sense.)";

inline constexpr char gripperCloseGrasp[] = R"(Closes a gripper on a thing of which the name is known. Does not wait.

Args:
    id: Which one.
    objName: The frame of the thing. Where nothing but the robot moves (KinematicDriver), it moves with the gripper from then on.
    force: N, at most the gripper's.
    width: Of the thing, m.
    speed: Of the width, m/s.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: There is no such gripper, or a number makes no sense.)";

inline constexpr char getGripperPos[] = R"(How far a gripper is open.

Args:
    id: Which one.
Returns:
    The width of its opening, m.
Raises:
    ArgumentError: There is no such gripper.)";

inline constexpr char gripperDone[] = R"(Whether a gripper has done what it was told.

Args:
    id: Which one.
Returns:
    True if it is as wide as it was told, or something holds its fingers up.
Raises:
    ArgumentError: There is no such gripper.)";

inline constexpr char attach[] = R"(Fixes a thing to another one in the simulated world, where it is.

Args:
    from_: A frame, such as the gripper.
    to: The thing.
Raises:
    FrameNotFound: There is no such frame.
    RobotFault: The robot is not simulated.)";

inline constexpr char detach[] = R"(Frees a thing in the simulated world.

Args:
    from_: What it was fixed to.
    to: The thing.
Raises:
    FrameNotFound: There is no such frame.
    RobotFault: The robot is not simulated.)";

inline constexpr char getContacts[] = R"(What touches in the simulated world now, as Simulation.getContacts says it.

Returns:
    A dict for each point: `frames` (two names, "ground" for the plane z = 0), `position` (m), `normal` (from the first
    to the second), `distance` (m, negative where they overlap), `force` (N, that the first exerts on the second); world.
    Nothing in a world without forces, and of a robot that is there.)";

inline constexpr char setFramePose[] = R"(Puts a thing of the simulated world somewhere.

Args:
    frame: Its name.
    pose: (7,) x y z in m, qw qx qy qz.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: It is no pose.
    RobotFault: The robot is not simulated.)";

inline constexpr char getImageAndDepth[] = R"(What a camera of the simulated world sees.

Args:
    sensorName: A frame; its attributes say which camera it is.
Returns:
    Colors (height, width, 3), 0..255, and depth (height, width) in m, -1 where nothing is.
Raises:
    FrameNotFound: There is no such frame.
    FileError: Nothing can be drawn on this machine.)";

inline constexpr char getImage[] = R"(The colors that a camera of the simulated world sees.

Args:
    sensorName: A frame; its attributes say which camera it is.
Returns:
    (height, width, 3), 0..255.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char getImageDepthPcl[] = R"(What a camera of the simulated world sees, also as points.

Args:
    sensorName: A frame; its attributes say which camera it is.
    globalCoordinates: Points in the axes of the world, not of the camera.
Returns:
    Colors (height, width, 3), depth (height, width) in m, points (height, width, 3) in m.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char getCameraFxycxy[] = R"(Which camera it is.

Args:
    sensorName: A frame; its attributes say which camera it is.
Returns:
    fx, fy, cx, cy in pixels, shape (4,).
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char CommandLog[] =
    R"(All that a robot was told, and when. From the same start the same log gives the same motion, to the bit.)";

inline constexpr char saveLog[] = R"(Writes the log into a file.

Args:
    path: Of the file.
Raises:
    FileError: It cannot be written.)";

inline constexpr char loadLog[] = R"(Reads a log from a file.

Args:
    path: Of the file.
Returns:
    The log.
Raises:
    FileError: It cannot be read.
    ParseError: It is no log; the message says where.)";

inline constexpr char logFromText[] = R"(Reads a log from what text() gave.

Args:
    text: The text.
Returns:
    The log.
Raises:
    ParseError: It is no log; the message says where.)";

inline constexpr char replay[] = R"(Does again what a log says, in virtual time, on a BotOp that is new.

Args:
    log: What getLog() gave.
Raises:
    ArgumentError: The robot was moved before, or the log has another period.
    FrameNotFound: The scene is not that of the log.)";

inline constexpr char recordTo[] =
    R"(Writes a row per period into a file from now on: time, q, velocity, and both as they shall be.

Args:
    path: Of the file; empty: none.
Raises:
    FileError: It cannot be written.)";

inline constexpr char RobotDriver[] =
    R"(What stands cancellation BotOp and a robot. Subclasses drive robots of your own.

Write info, read, write and stop; where there is something to do, also connect, disconnect, recover, moveGripper, and for
simulated robots step. Calls come from one thread at a time. What they raise stops the robot, and is told as a RobotFault.)";

inline constexpr char write[] = R"(Moves the robot.

Args:
    command: Where it shall be a period from now, within its limits.)";

inline constexpr char stopRobot[] =
    R"(Something is wrong: come to rest. Called once; then nothing is written until recover().

Args:
    reason: What is wrong.)";

inline constexpr char moveGripper[] = R"(Moves a gripper.

Args:
    command: What it shall do.
Raises:
    RobotFault: The robot has no grippers.)";

inline constexpr char step[] =
    R"(Simulated time goes on. The time of a robot that is there goes on by itself: it does nothing.

Args:
    period: s.)";

inline constexpr char GripperInfo[] = R"(A gripper.

Args:
    name: Of the gripper.
    min_width, max_width: Of the opening, m.
    max_speed: Of the width, m/s.
    max_force: N.)";

inline constexpr char GripperState[] = R"(A gripper as it is.

Args:
    width: Of the opening, m.
    is_done: It has reached the width it was told, or something holds it up.)";

inline constexpr char RobotInfo[] = R"(What a robot is. Limits that are left out are infinite.

Args:
    name: For messages.
    joints: One name per entry of q, in the order of Config.getJointNames.
    lower, upper: (n,) limits of q, rad or m.
    velocity, acceleration: (n,) largest ones.
    effort: (n,) N m or N.
    rate: Commands per second that it wants, Hz.
    compliant: Can it be less stiff than fully?
    grippers: A GripperInfo for each.
Raises:
    ArgumentError: Sizes that do not fit, or limits that are not positive.)";

inline constexpr char RobotInfo_of[] = R"(The joints of a scene with their limits; none on accelerations, no grippers.

Args:
    config: The scene.
    name: Of the robot.
Returns:
    The info.)";

inline constexpr char RobotState[] = R"(A robot as it is.

Args:
    time: Of the robot's clock, s. If it stands still, the robot is stopped.
    q: (n,) rad or m.
    velocity: (n,) rad/s or m/s.
    effort: (n,) of its motors, N m or N; empty if unknown.
    external_effort: (n,) by what it touches; empty if unknown.
    grippers: A GripperState for each gripper.
    error: What the robot says is wrong; empty if nothing is.
Raises:
    ArgumentError: What should be numbers is none.)";

inline constexpr char KinematicDriver[] =
    R"(A robot that is exactly where it is told to be, in a world where nothing else moves: no forces, no contacts.)";

inline constexpr char KinematicDriver_make[] = R"(A world of its own, as a scene is now.

Args:
    config: The scene.)";

inline constexpr char SimulatedDriver[] =
    R"(A robot in a simulated world with masses, contacts and friction: what a gripper holds, it holds by force.)";

inline constexpr char SimulatedDriver_make[] = R"(A world of its own, as a scene is now.

Args:
    config: The scene.
    options: Of the simulation.
Raises:
    ArgumentError: The scene cannot be simulated; the message says why.)";

inline constexpr char RecordedDriver[] =
    R"(A robot of which everything is known beforehand: what it will say. It notes what it is told. For tests.)";

inline constexpr char RecordedDriver_make[] = R"(A robot that says these things.

Args:
    info: What robot it is.
    states: What read() gives, one after the other; then the last one for ever. If empty, the robot is where it was told to be.
    start: (n,) where it is at first, without states.
Raises:
    ArgumentError: Neither states nor a start.)";

}  // namespace kinegraph::python::docs::operation
