#pragma once

/// Docstrings for bind_simulation_batch.cpp.
namespace kinegraph::python::docs::simulation_batch {

inline constexpr char type[] = R"(Steps N simulations of one scene in parallel threads.

An environment behaves like a Simulation with the same calls, bit for bit, for any number of threads. The Config is
copied and does not change.)";

inline constexpr char make[] = R"(Creates N environments with the state of C.

Args:
    C: The scene. Not modified.
    n: Number of environments.
    threads: Number of threads.
    engine: See Simulation.
    options: SimulationOptions, or a dict of some of their fields.
Raises:
    ArgumentError: Less than one environment or thread, or a scene that cannot be simulated.
    TypeError: C is no Config.)";

inline constexpr char step[] = R"(Advances all environments by `repeat` steps of tau seconds.

Args:
    u: (N, n), a row for each environment; (N, 2n) for positionVelocity; none for none and spline.
    tau: s, > 0.
    u_mode: Meaning of u.
    repeat: Number of steps with the same u.
Raises:
    ArgumentError: u has a wrong shape; nothing has changed.
    Error: An environment diverges; it keeps its previous state, and all others have stepped.
    KeyboardInterrupt: Ctrl-C; some environments have stepped, others have not.)";

inline constexpr char getState[] = R"(Returns the complete state of an environment.

Args:
    environment: 0 to N - 1.
Returns:
    A SimulationState, see Simulation.getState.
Raises:
    ArgumentError: There is no such environment.)";

inline constexpr char setState[] =
    R"(Sets the state of an environment, from any environment or Simulation of the same scene.

Args:
    environment: 0 to N - 1.
    state: A SimulationState.
Raises:
    ArgumentError: There is no such environment, or the state belongs to another scene.)";

inline constexpr char reset[] = R"(Resets environments to the initial Config.

Args:
    environments: Their indices, such as np.flatnonzero(done); all for None.
Raises:
    ArgumentError: There is no such environment.)";

inline constexpr char place[] = R"(Sets joints and free frames, at rest. Motors hold the new joint values.

Args:
    environments: Their indices, such as np.flatnonzero(done); all for None.
    q: (K, n), one joint state per environment.
    freePos: (K, F, 7), poses of the free frames; if empty, they do not change.
Raises:
    ArgumentError: There is no such environment, or a shape is wrong.)";

inline constexpr char closeGrippers[] = R"(Moves the fingers of all environments, in the steps that follow.

Args:
    gripperFrameName: A frame of the link that carries the fingers.
    widths: Distance between the fingers, m, one number or (N,).
    speed: Speed of each finger, m/s.
    force: Force of each finger, N.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: There is no gripper, or a number is out of range.)";

inline constexpr char setMasses[] =
    R"(Sets the mass of a frame's body per environment; its inertia scales with the mass.

Args:
    frame: Its name.
    masses: kg, > 0, one number or (N,).
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: The body cannot move, or a number is out of range.)";

inline constexpr char setFrictions[] = R"(Sets the friction of a frame's shape per environment.

Args:
    frame: Its name; it must have the attribute `friction`.
    frictions: >= 0, one number or (N,). A contact uses the mean of both shapes.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: It has no shape or no such attribute, or a number is out of range.)";

}  // namespace kinegraph::python::docs::simulation_batch
