#pragma once

/// The manual of what bind_simulation.cpp binds.
namespace kinegraph::python::docs::simulation {

inline constexpr char type[] = R"(A configuration in time: joints with motors, things that fall, contacts, grippers.

It works directly on C, whose joints and free frames follow each step. What moves: joints, by their motors; frames without
parent, or with a rigid joint, that have a mass, freely; nothing else. Shapes that are transparent (alpha < 1) take no part,
unless their frame says `simulate: true`. The same calls give the same numbers, bit for bit, and no display is needed.
docs/simulation.md tells all.)";

inline constexpr char make[] = R"(A simulation of C as it is.

Args:
    C: The scene; every step changes it.
    engine: physx (rigid bodies with contacts) or kinematic (joints follow their references, nothing else moves).
    verbose: 2 or more: the page shows it live, see view(), and opens; less: it does not; None: it does if C.view() has opened
        it before.
    options: SimulationOptions, or a dict of some of their fields.
Raises:
    ArgumentError: Something that cannot be simulated, such as a negative mass; the engine bullet; a bad option.
    FileError: MuJoCo is not there.
    TypeError: C is no Config.)";

inline constexpr char state[] = R"(A simulation at one time: all that decides what will happen.

Fields may be changed before setState restores it. What a field does not show (targets of motors and grippers, what is
attached, how solvers start) is in it, too. It can be pickled and compared.)";

inline constexpr char step[] = R"(Goes on by tau seconds.

Args:
    u_control: (n,), a number for each entry of the joint state; (2n,) for positionVelocity; none for none and spline.
    tau: s, > 0. It is divided into inner steps of options.inner_step or less.
    u_mode: How u_control is meant.
Raises:
    ArgumentError: u_control does not fit, or has numbers that are not finite; nothing has changed then.
    Error: Numbers leave all bounds; the state is as before the call.
    KeyboardInterrupt: Ctrl-C during a long step; the state is as before it.)";

inline constexpr char resetTime[] = R"(Sets the time, and makes the spline one that stays at the present q.

Args:
    time: s.
Raises:
    ArgumentError: time is not finite.)";

inline constexpr char getFreeFrames[] = R"(The frames that move freely.

Returns:
    Frames, in the order of freePos and of get_frameVelocities.)";

inline constexpr char get_frameVelocities[] = R"(Velocities of the free frames.

Returns:
    (F, 2, 3): linear (m/s) and angular (rad/s), world.)";

inline constexpr char getState[] = R"(All that decides what will happen.

Returns:
    A SimulationState; setState with it makes what follows the same again, bit for bit.)";

inline constexpr char setState[] =
    R"(Goes back to a state, of this simulation or of another of the same scene. C follows.

Args:
    state: Of getState; fields that were changed count. Or poses of all frames, as C.getFrameState() has them: what follows then
        starts from there, at time and with targets as they are.
    jointState: (n,), with poses of frames; else q is what they say.
    frameVelocities: (F, 2, 3) of the free frames, with poses of frames; else they rest.
    jointVelocities: (n,), likewise.
Raises:
    ArgumentError: It is of another scene, or has numbers that make no sense.)";

inline constexpr char pushConfigToSim[] = R"(Puts everything to where it is in C now, and lets motors hold it there.

Args:
    frameVelocities: (F, 2, 3) of the free frames, linear and angular; else they rest.
    jointVelocities: (n,); else joints rest.
Raises:
    ArgumentError: Wrong shapes.)";

inline constexpr char setVerbose[] = R"(As in the constructor.

Args:
    verbose: 2 or more: the page shows it live, and opens; less: it does not.)";

inline constexpr char view[] = R"(Shows the simulation live on C's page, from now on with each step.

The page shows time, real-time factor, contacts and their forces, and has buttons to pause, to take one step, and to reset the
simulation to where it was at the first call of this. A body that is dragged there (button `pull`) is drawn to the mouse by a
spring; sliders and handles put things elsewhere. All that takes place in the next step; who touches nothing changes nothing.
A paused simulation waits within `step`, until it goes on, or 5 s after the last page was closed.

Args:
    pause: Waits for a key.
    message: Shown in the corner.
Returns:
    The code of the key that was pressed since the last call, or 0.
Raises:
    KeyboardInterrupt: Ctrl-C while waiting.)";

inline constexpr char view_close[] = R"(Shows it no longer, and ends the page.)";

inline constexpr char run[] =
    R"(Lets the simulation run along its spline: step([], tau, ControlMode.spline) again and again.

As fast as it can be computed or, while a browser shows it, as fast as the clock on the wall.

Args:
    seconds: Simulated time; None: until somebody presses q or Escape on the page.
    tau: s of each step.
    speed: Times real time, while a browser shows it; <= 0: as fast as possible.
Returns:
    The code of the key that was pressed on the page, or 0; q and Escape end it.
Raises:
    ArgumentError: Times that are not positive; no seconds where nobody can press a key.
    Error: Numbers leave all bounds.
    KeyboardInterrupt: Ctrl-C.)";

inline constexpr char viewRecording[] = R"(Plays the run on a page of its own, with a time slider.

Args:
    pause: Waits for a key at the end.
    message: Shown in the corner.
Returns:
    The code of the key that was pressed, or 0.
Raises:
    ArgumentError: It has no steps.
    KeyboardInterrupt: Ctrl-C while waiting.)";

inline constexpr char saveHtml[] = R"(Saves a page that plays the run, with a time slider, and needs no program.

Args:
    path: Of the HTML file.
Raises:
    ArgumentError: It has no steps.
    FileError: The file cannot be written.)";

inline constexpr char perturb[] =
    R"(Pulls a point to a place, as a hand would: by a damped spring, until endPerturbation.

The force is m (w^2 (target - p) - 2 w dp/dt): p is the point, m the mass of the frame's link with all that hangs on its joints,
w = 10 rad/s. One point at a time.

Args:
    frame: A frame of the link, or its name.
    point: (3,), m, in the frame's axes.
    target: (3,), m, world.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: It is fixed to the world, or a number is not finite.)";

inline constexpr char endPerturbation[] = R"(Lets go of what is pulled.)";

inline constexpr char getPerturbation[] = R"(What is pulled, by pull() or on the page.

Returns:
    position, target (m) and force (N) of the last inner step, each (3,), world; None if nothing is.)";

inline constexpr char setSplineRef[] =
    R"(A motion for mode spline: a cubic B-spline through the present reference and these points.

Args:
    path: (K, n) control points, or (n,) for one.
    times: (K,) in s, or one number: the time of all, in equal parts.
    append: After the present spline, at rest in cancellation; else from now on, smoothly.
Raises:
    ArgumentError: Shapes do not fit, or times are not positive and rising.)";

inline constexpr char getTimeToSplineEnd[] = R"(How long the spline still goes on.

Returns:
    s; negative after its end, 0 without one.)";

inline constexpr char resetSplineRef[] = R"(Makes the spline one that stays at the present q.

Args:
    ctrl_time: When it is said to have ended, s; negative: now.)";

inline constexpr char multi_step[] = R"(Several steps in mode spline: round(tau_step / tau_sim) of them.

Args:
    tau_step: s in all.
    tau_sim: s each.
Raises:
    ArgumentError: Times that are not positive.
    Error: Numbers leave all bounds.
    KeyboardInterrupt: Ctrl-C.)";

inline constexpr char moveGripper[] = R"(Moves fingers to a width, in the steps that follow; each with at most 20 N.

Args:
    gripperFrameName: A frame of the link that carries the fingers, such as "l_gripper".
    width: m cancellation the fingers.
    speed: m/s of each finger.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: It has no gripper, or a number makes no sense.)";

inline constexpr char closeGripper[] =
    R"(Closes fingers with a force, until something is in cancellation, in the steps that follow.

Args:
    gripperFrameName: A frame of the link that carries the fingers.
    width: m cancellation the fingers if nothing is.
    speed: m/s of each finger.
    force: N of each finger.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: It has no gripper, or a number makes no sense.)";

inline constexpr char gripperIsDone[] = R"(Whether fingers have arrived, to .1 mm, or something stops them.

Args:
    gripperFrameName: As for moveGripper.
Returns:
    True or False.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: It has no gripper.)";

inline constexpr char getGripperWidth[] = R"(How far fingers are apart.

Args:
    gripperFrameName: As for moveGripper.
Returns:
    m cancellation the fingers: twice the joint's value.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: It has no gripper.)";

inline constexpr char attach[] = R"(Holds the link of a frame to that of another, as they are.

Args:
    frm: Frame that holds.
    to: Frame that is held.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: They are one link, or 32 things are attached already.)";

inline constexpr char detach[] = R"(Ends what attach began.

Args:
    frm: Frame that holds.
    to: Frame that is held.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: They are not attached.)";

inline constexpr char getContacts[] = R"(What touches, at the beginning of the last inner step.

Returns:
    A dict for each point: `frames` (two names, "ground" for the plane z = 0), `position` (m), `normal` (from the first
    to the second), `distance` (m, negative where they overlap), `force` (N, that the first exerts on the second); world.)";

inline constexpr char getJointTorques[] = R"(What motors exerted in the last inner step.

Returns:
    (n,) in N m or N, what compensates gravity within the robot not counted.)";

inline constexpr char getExternalTorques[] =
    R"(What acts on joints besides motors: contacts, limits, what is attached, perturbations.

Returns:
    (n,) in N m or N.)";

inline constexpr char addForceTorqueSensor[] = R"(Puts a sensor where a frame is fixed to its link, or to its joint.

Args:
    frame: What is below it pulls at it.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char getForceTorque[] = R"(What a sensor measured in the last inner step.

Args:
    frame: Of addForceTorqueSensor.
Returns:
    (6,): force (N) and torque (N m) that what is above the frame exerts on it, in its axes.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: It has no sensor.)";

inline constexpr char addAccelerometer[] = R"(Puts an accelerometer on a frame.

Args:
    frame: The frame.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char getAcceleration[] = R"(What an accelerometer measured in the last inner step.

Args:
    frame: Of addAccelerometer.
Returns:
    (3,) in m/s^2, in the frame's axes: at rest 9.81 upwards.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: It has no sensor.)";

inline constexpr char applyForce[] =
    R"(Lets a force and a torque act on the link of a frame until clearForces; several add up.

Args:
    frame: The frame.
    force: (3,) in N, world.
    torque: (3,) in N m, world.
    point: (3,) where the force acts, world, m; else at the frame.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: The frame cannot move, or numbers make no sense.)";

inline constexpr char clearForces[] = R"(Ends all of perturb.)";

inline constexpr char addSensor[] = R"(Adds a camera and selects it.

Args:
    sensorName: Its name.
    frameAttached: The frame that it looks from, whose attributes say what it is like (see CameraView.setCamera); else the frame
        of that name.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: Attributes that no camera can have.)";

inline constexpr char selectSensor[] = R"(Chooses the camera of getImageAndDepth.

Args:
    sensorName: Of addSensor.
Raises:
    NotFound: There is no such camera.)";

inline constexpr char setCamera[] = R"(Looks from a frame and follows it.

Args:
    sensorName: The frame: its name, id or Frame.
Returns:
    The camera.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: Attributes that no camera can have.)";

inline constexpr char getImageAndDepth[] = R"(What the selected camera sees; without one, one that overlooks the scene.

Returns:
    The image, shape (height, width, 3), 0..255, and the depth along the camera's z axis, shape (height, width), m; -1
    where nothing is.
Raises:
    Error: Drawing needs EGL, which is not there.)";

inline constexpr char setSimulateDepthNoise[] =
    R"(Lets depth have the errors of a stereo camera (parameters DepthNoise/...), the same at the same time.

Args:
    _setSimulateDepthNoise: True or False.)";

inline constexpr char depthData2pointCloud[] = R"(Points of a depth image in the camera's frame.

Args:
    depth: (height, width), float32, m.
    fxycxy: fx, fy, cx, cy in pixels.
Returns:
    (height, width, 3); zeros where the depth is negative.
Raises:
    ArgumentError: fxycxy does not have 4 numbers.)";

inline constexpr char recording[] =
    R"(A run of a simulation: the scene, where it started, all calls, and where everything was after each step.)";

inline constexpr char save[] = R"(Writes the recording into a file.

Args:
    path: The file.
Raises:
    FileError: It cannot be written.)";

inline constexpr char load[] = R"(Reads the file of a recording.

Args:
    path: The file.
Returns:
    A SimulationRecording.
Raises:
    FileError: It cannot be read.
    ArgumentError: It is no recording.)";

inline constexpr char makeConfig[] = R"(The scene as it was at the start.

Returns:
    A Config.)";

inline constexpr char replay[] = R"(Does it all again, bit for bit.

Args:
    C: Of makeConfig.
Returns:
    The Simulation at the end.
Raises:
    Error: It ends otherwise than it did; it may be of another version or machine.)";

inline constexpr char startRecording[] = R"(From now on everything that is asked of the simulation is kept.)";

inline constexpr char stopRecording[] = R"(Ends what startRecording began.

Returns:
    A SimulationRecording.
Raises:
    ArgumentError: startRecording was not called.)";

}  // namespace kinegraph::python::docs::simulation
