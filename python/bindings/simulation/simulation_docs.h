#pragma once

/// Docstrings for bind_simulation.cpp.
namespace kinegraph::python::docs::simulation {

inline constexpr char type[] = R"(Simulates a configuration: joints with motors, free bodies, contacts, grippers.

It works directly on C: its joints and free frames are updated after every step. Joints move by their motors. Frames
without parent, or with a rigid joint, move freely if they have a mass. Everything else is fixed. Transparent shapes
(alpha < 1) do not collide, unless their frame says `simulate: true`. The same calls give the same numbers, bit for bit,
and no display is needed. See docs/simulation.md.)";

inline constexpr char make[] = R"(Creates a simulation that starts at the present state of C.

Args:
    C: The scene; every step changes it.
    engine: physx (rigid bodies with contacts) or kinematic (joints follow their references, nothing else moves).
    verbose: 2 or more: the page opens and shows the simulation live, see view(); less: no page; None: live if C.view()
        has opened the page before.
    options: SimulationOptions, or a dict of some of their fields.
Raises:
    ArgumentError: The scene cannot be simulated, for instance with a negative mass; the engine bullet; an invalid
        option.
    FileError: MuJoCo is missing.
    TypeError: C is no Config.)";

inline constexpr char state[] = R"(The complete state of a simulation.

Fields may be changed before setState restores it. It also contains what no field shows: targets of motors and grippers,
attachments, and the solvers' warm start. It can be pickled and compared.)";

inline constexpr char step[] = R"(Advances the simulation by tau seconds.

Args:
    u_control: (n,), one entry per entry of the joint state; (2n,) for positionVelocity; none for none and spline.
    tau: s, > 0. Divided into inner steps of at most options.inner_step.
    u_mode: Meaning of u_control.
Raises:
    ArgumentError: u_control has a wrong size or is not finite; nothing has changed.
    Error: The simulation diverges; the state before the call is restored.
    KeyboardInterrupt: Ctrl-C during a long step; the state before it is restored.)";

inline constexpr char resetTime[] = R"(Sets the time, and replaces the spline by the present q.

Args:
    time: New time, s.
Raises:
    ArgumentError: time is not finite.)";

inline constexpr char getFreeFrames[] = R"(Returns the frames that move freely.

Returns:
    The frames, in the order of freePos and of get_frameVelocities.)";

inline constexpr char get_frameVelocities[] = R"(Returns the velocities of the free frames.

Returns:
    (F, 2, 3): linear (m/s) and angular (rad/s), world.)";

inline constexpr char getState[] = R"(Returns the complete state.

Returns:
    A SimulationState. After setState with it, the simulation repeats bit for bit.)";

inline constexpr char setState[] =
    R"(Restores a state of this simulation, or of another one of the same scene, and updates C.

Args:
    state: From getState; changed fields are respected. Or poses of all frames as from C.getFrameState(): the simulation
        continues from there, with unchanged time and targets.
    jointState: (n,), with poses of frames; by default, q follows from the poses.
    frameVelocities: (F, 2, 3) of the free frames, with poses of frames; by default at rest.
    jointVelocities: (n,), likewise.
Raises:
    ArgumentError: The state belongs to another scene, or a number is out of range.)";

inline constexpr char pushConfigToSim[] = R"(Sets poses and joints to those of C; motors hold them.

Args:
    frameVelocities: (F, 2, 3) of the free frames, linear and angular; by default at rest.
    jointVelocities: (n,); by default at rest.
Raises:
    ArgumentError: Wrong shapes.)";

inline constexpr char setVerbose[] = R"(Opens or closes the live page, as in the constructor.

Args:
    verbose: 2 or more: the page opens and shows the simulation live; less: no page.)";

inline constexpr char view[] = R"(Shows the simulation live on C's page, from now on with each step.

The page shows time, real-time factor, contacts and their forces. Buttons pause the simulation, advance it by one step,
and reset it to its state at the first call of view(). With the button `perturb`, a spring moves a dragged body to the
mouse; sliders and handles set joints and poses. All requests take effect in the next step; without requests, the
simulation is unaffected. A paused simulation waits within `step` until it is resumed, or until 5 s after the last page
was closed.

Args:
    pause: Whether to wait for a key.
    message: Text in the corner of the page.
Returns:
    The code of the key that was pressed since the last call, or 0.
Raises:
    KeyboardInterrupt: Ctrl-C while waiting.)";

inline constexpr char view_close[] = R"(Ends the live view, and closes the page.)";

inline constexpr char run[] =
    R"(Runs the simulation along its spline: repeats step([], tau, ControlMode.spline).

It runs in real time while a browser shows it, otherwise as fast as possible.

Args:
    seconds: Simulated duration, s; None: until a user presses q or Escape on the page.
    tau: Duration of each step, s.
    speed: Factor of real time while a browser shows it; <= 0: unlimited.
Returns:
    The code of the key that was pressed on the page, or 0; q and Escape end it.
Raises:
    ArgumentError: A time is not positive; or seconds is None and no page is open.
    Error: The simulation diverges.
    KeyboardInterrupt: Ctrl-C.)";

inline constexpr char viewRecording[] = R"(Plays the run on its own page, with a time slider.

Args:
    pause: Whether to wait for a key at the end.
    message: Text in the corner of the page.
Returns:
    The code of the key that was pressed, or 0.
Raises:
    ArgumentError: The recording has no steps.
    KeyboardInterrupt: Ctrl-C while waiting.)";

inline constexpr char saveHtml[] = R"(Saves an HTML page that plays the run without a program, with a time slider.

Args:
    path: Path of the HTML file.
    client: Path of a file with the script of all such pages, as in Viewer.saveHtml. None: the page contains it.
Raises:
    ArgumentError: The recording has no steps.
    FileError: A file cannot be written, or client is another file.)";

inline constexpr char perturb[] =
    R"(Moves a point of a link to a target by a damped spring, until endPerturbation.

The force is m (w^2 (target - p) - 2 w dp/dt): p is the point, m the mass of the frame's link and all links below it,
and w = 10 rad/s. m is at most ten times the inertia that the point resists with, and a target beyond 0.3 m pulls as
from 0.3 m. The force is at most 60 m/s^2 m. At most one perturbation is active.

Args:
    frame: A frame of the link, or its name.
    point: (3,), m, in the frame's axes.
    target: (3,), m, world.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: The frame is fixed to the world, or a number is not finite.)";

inline constexpr char endPerturbation[] = R"(Ends the perturbation.)";

inline constexpr char getPerturbation[] = R"(Returns the active perturbation, from perturb() or from the page.

Returns:
    position, target (m) and force (N) of the last inner step, each (3,), world; None without a perturbation.)";

inline constexpr char setSplineRef[] =
    R"(Sets the trajectory of mode spline: a cubic B-spline from the present reference through these control points.

Args:
    path: (K, n) control points, or (n,) for one.
    times: (K,) in s, or one number: the total duration, divided equally.
    append: Whether to append it after the present spline, with rest in between; otherwise it blends smoothly from now
        on.
Raises:
    ArgumentError: A shape is wrong, or times are not positive and increasing.)";

inline constexpr char getTimeToSplineEnd[] = R"(Returns the remaining time of the spline.

Returns:
    The time in s; negative after the end, 0 without a spline.)";

inline constexpr char resetSplineRef[] = R"(Replaces the spline by the present q.

Args:
    ctrl_time: End time of the new spline, s; negative: now.)";

inline constexpr char multi_step[] = R"(Runs round(tau_step / tau_sim) steps in mode spline.

Args:
    tau_step: Total duration, s.
    tau_sim: Duration of each step, s.
Raises:
    ArgumentError: A time is not positive.
    Error: The simulation diverges.
    KeyboardInterrupt: Ctrl-C.)";

inline constexpr char moveGripper[] = R"(Moves fingers to a width during the following steps, each with at most 20 N.

Args:
    gripperFrameName: A frame of the link that carries the fingers, such as "l_gripper".
    width: Distance between the fingers, m.
    speed: Speed of each finger, m/s.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: There is no gripper, or a number is out of range.)";

inline constexpr char closeGripper[] =
    R"(Closes fingers during the following steps, until an object blocks them.

Args:
    gripperFrameName: A frame of the link that carries the fingers.
    width: Final distance between the fingers without an object, m.
    speed: Speed of each finger, m/s.
    force: Force of each finger, N.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: There is no gripper, or a number is out of range.)";

inline constexpr char gripperIsDone[] = R"(Returns whether fingers are at their target within .1 mm, or are blocked.

Args:
    gripperFrameName: See moveGripper.
Returns:
    True or False.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: There is no gripper.)";

inline constexpr char getGripperWidth[] = R"(Returns the distance between the fingers.

Args:
    gripperFrameName: See moveGripper.
Returns:
    The distance in m: twice the joint's value.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: There is no gripper.)";

inline constexpr char attach[] = R"(Fixes the link of a frame to that of another at their present relative pose.

Args:
    frm: Frame of the holding link.
    to: Frame of the held link.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: Both are the same link, or 32 links are attached already.)";

inline constexpr char detach[] = R"(Ends an attachment.

Args:
    frm: Frame of the holding link.
    to: Frame of the held link.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: They are not attached.)";

inline constexpr char getContacts[] = R"(Returns the contacts at the beginning of the last inner step.

Returns:
    A dict per contact point, in world coordinates: `frames` (two names, "ground" for the plane z = 0), `position` (m),
        `normal`
    (from the first to the second), `distance` (m, negative if they overlap), `force` (N, exerted by the first on the
    second).)";

inline constexpr char getJointTorques[] = R"(Returns the torques of the motors in the last inner step.

Returns:
    (n,) in N m or N, without the gravity compensation within the robot.)";

inline constexpr char getExternalTorques[] =
    R"(Returns the external joint torques: of contacts, limits, attachments, forces and perturbations.

Returns:
    (n,) in N m or N.)";

inline constexpr char addForceTorqueSensor[] = R"(Adds a force-torque sensor between a frame and its link or joint.

Args:
    frame: The sensor measures the force of everything below this frame.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char getForceTorque[] = R"(Returns the measurement of a force-torque sensor in the last inner step.

Args:
    frame: The frame of addForceTorqueSensor.
Returns:
    (6,): force (N) and torque (N m) exerted on the frame by its link, in the frame's axes.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: The frame has no sensor.)";

inline constexpr char addAccelerometer[] = R"(Adds an accelerometer at a frame.

Args:
    frame: The frame.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char getAcceleration[] = R"(Returns the measurement of an accelerometer in the last inner step.

Args:
    frame: The frame of addAccelerometer.
Returns:
    (3,) in m/s^2, in the frame's axes: at rest 9.81 upwards.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: The frame has no sensor.)";

inline constexpr char applyForce[] =
    R"(Applies a constant force and torque to the link of a frame until clearForces. Several calls add up.

Args:
    frame: The frame.
    force: (3,) in N, world.
    torque: (3,) in N m, world.
    point: (3,), point of action, world, m; by default the frame's origin.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: The frame cannot move, or a number is not finite.)";

inline constexpr char clearForces[] = R"(Removes all forces of applyForce.)";

inline constexpr char addSensor[] = R"(Adds a camera and selects it.

Args:
    sensorName: Name of the camera.
    frameAttached: The camera's frame, with camera attributes (see CameraView.setCamera); by default the frame of that
        name.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: The camera attributes are invalid.)";

inline constexpr char selectSensor[] = R"(Selects the camera of getImageAndDepth.

Args:
    sensorName: Name from addSensor.
Raises:
    NotFound: There is no such camera.)";

inline constexpr char setCamera[] = R"(Attaches the camera to a frame.

Args:
    sensorName: The frame: its name, id or Frame.
Returns:
    The camera.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: The camera attributes are invalid.)";

inline constexpr char getImageAndDepth[] =
    R"(Renders the image and depth of the selected camera, by default of one that overlooks the scene.

Returns:
    The image, shape (height, width, 3), 0..255, and the depth along the camera's z axis, shape (height, width), m; -1
    for the background.
Raises:
    Error: Rendering needs EGL, which is missing.)";

inline constexpr char setSimulateDepthNoise[] =
    R"(Adds the errors of a stereo camera to depth images (parameters DepthNoise/...), reproducible at equal times.

Args:
    _setSimulateDepthNoise: True or False.)";

inline constexpr char depthData2pointCloud[] = R"(Converts a depth image to points in the camera's frame.

Args:
    depth: (height, width), float32, m.
    fxycxy: fx, fy, cx, cy in pixels.
Returns:
    (height, width, 3); zeros for negative depths.
Raises:
    ArgumentError: fxycxy does not have 4 entries.)";

inline constexpr char recording[] =
    R"(A recorded run of a simulation: the scene, the start state, all calls, and the poses after each step.)";

inline constexpr char save[] = R"(Writes the recording to a file.

Args:
    path: The file.
Raises:
    FileError: The file cannot be written.)";

inline constexpr char load[] = R"(Reads a recording from a file.

Args:
    path: The file.
Returns:
    A SimulationRecording.
Raises:
    FileError: The file cannot be read.
    ArgumentError: The file is not a recording.)";

inline constexpr char makeConfig[] = R"(Returns the scene at the start of the run.

Returns:
    A Config.)";

inline constexpr char replay[] = R"(Repeats the run, bit for bit.

Args:
    C: Scene from makeConfig.
Returns:
    The Simulation at the end.
Raises:
    Error: The final state differs from the recorded one; the recording may come from another version or machine.)";

inline constexpr char startRecording[] = R"(Starts to record all calls.)";

inline constexpr char stopRecording[] = R"(Ends the recording and returns it.

Returns:
    A SimulationRecording.
Raises:
    ArgumentError: startRecording was not called.)";

inline constexpr char recordTo[] =
    R"(Records step and multi_step into a file .mcap from now on: joint states, poses, clock, images (docs/mcap.md).

Args:
    path: Path of the file, which is replaced; empty ends the recording.
    rate: Samples per second, Hz; at most one per step.
    cameras: Camera frames whose images are recorded as JPEG.
    camera_rate: Images per second, Hz.
    start: Unix time of simulated time 0, s.
Raises:
    FileError: The file cannot be written.
    ArgumentError: The name does not end in .mcap, or a rate or start is invalid.
    FrameNotFound: There is no such camera.
    NotFound: The packages of the extra `mcap` are not installed.)";

}  // namespace kinegraph::python::docs::simulation
