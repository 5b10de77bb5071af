#pragma once

/// The manual of what bind_simulation_batch.cpp binds.
namespace kinegraph::python::docs::simulation_batch {

inline constexpr char type[] = R"(N simulations of one scene, stepped by threads.

An environment does the same as a Simulation that gets the same calls, bit for bit, at any number of threads. The Config that it
is made of does not change.)";

inline constexpr char make[] = R"(N environments, each as C is.

Args:
    C: The scene; it stays as it is.
    n: How many environments.
    threads: How many threads step them.
    engine: As for Simulation.
    options: SimulationOptions, or a dict of some of their fields.
Raises:
    ArgumentError: Less than one environment or thread, or a scene that cannot be simulated.
    TypeError: C is no Config.)";

inline constexpr char step[] = R"(All environments go on by tau seconds, `repeat` times.

Args:
    u: (N, n), a row for each environment; (N, 2n) for positionVelocity; none for none and spline.
    tau: s, > 0.
    u_mode: How u is meant.
    repeat: Steps with the same u.
Raises:
    ArgumentError: u does not fit; nothing has changed then.
    Error: Numbers of an environment leave all bounds; it stays as it was before, and all others have stepped.
    KeyboardInterrupt: Ctrl-C; some environments have stepped, others not.)";

inline constexpr char getState[] = R"(All that decides what an environment will do.

Args:
    environment: 0 to N - 1.
Returns:
    A SimulationState, as of Simulation.getState.
Raises:
    ArgumentError: There is no such environment.)";

inline constexpr char setState[] =
    R"(Brings an environment to a state of any environment of the same scene, or of a Simulation of it.

Args:
    environment: 0 to N - 1.
    state: A SimulationState.
Raises:
    ArgumentError: There is no such environment, or the state is of another scene.)";

inline constexpr char reset[] = R"(Brings environments back to how the Config was.

Args:
    environments: Their numbers; all if empty.
Raises:
    ArgumentError: There is no such environment.)";

inline constexpr char place[] = R"(Puts joints and free frames somewhere else, at rest. Motors want to stay there.

Args:
    environments: Their numbers; all if empty.
    q: (K, n), a joint state for each of them.
    freePos: (K, F, 7), poses of the free frames; if empty they stay where they are.
Raises:
    ArgumentError: There is no such environment, or shapes do not fit.)";

inline constexpr char closeGrippers[] = R"(Moves the fingers of all environments, in the steps that follow.

Args:
    gripperFrameName: A frame of the link that carries the fingers.
    widths: m cancellation the fingers, one number or (N,).
    speed: m/s of each finger.
    force: N of each finger.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: It has no gripper, or numbers make no sense.)";

inline constexpr char setMasses[] =
    R"(Gives the body of a frame another mass in each environment; its inertia grows with it.

Args:
    frame: Its name.
    masses: kg, > 0, one number or (N,).
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: It cannot move, or numbers make no sense.)";

inline constexpr char setFrictions[] = R"(Gives the shape of a frame another friction in each environment.

Args:
    frame: Its name; it must have the attribute `friction`.
    frictions: >= 0, one number or (N,). Between two shapes the mean counts.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: It has no shape or no such attribute, or numbers make no sense.)";

}  // namespace kinegraph::python::docs::simulation_batch
