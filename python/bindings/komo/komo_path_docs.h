#pragma once

/// The manual of what bind_komo_path.cpp binds.
namespace kinegraph::python::docs::komo_path {

inline constexpr char getPath[] = R"(The joint vectors of all slices.

Args:
    dofIndices: Ids of frames, to get only the dofs of their joints; [] for all.
Returns:
    Shape (T, n), rad or m.
Raises:
    ArgumentError: A frame without an active joint.)";

inline constexpr char getFrameState[] = R"(World poses of all frames in a slice.

Args:
    t: The slice.
Returns:
    Shape (frames, 7): x y z (m) qw qx qy qz.
Raises:
    ArgumentError: There is no such slice.)";

inline constexpr char getFrame[] = R"(A frame as it is in a slice.

Args:
    frameName: Its name.
    phaseTime: Time of the slice in phases.
Returns:
    A copy of the frame.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char getConfiguration[] = R"(The scene in a slice.

Args:
    t: The slice; -1 is the one before the first.
Returns:
    A copy.
Raises:
    ArgumentError: There is no such slice.)";

inline constexpr char getSubProblem[] =
    R"(What is needed to plan the motion of a phase, for a KOMO with one slice per phase.

Args:
    phase: The phase.
Returns:
    The scene at the beginning of the phase, q at the beginning, shape (n,), and q at the end, shape (n,).
Raises:
    ArgumentError: There is no such phase.)";

inline constexpr char getForceInteractions[] =
    R"(Contact forces, a dict per force and slice: `from` pushes `onto` at `poa` (m) with `force` (N), both shape (3,), in
the world.)";

inline constexpr char initWithConstant[] = R"(Starts with one joint vector in all slices.

Args:
    q: Shape (n,), rad or m.
Raises:
    ArgumentError: q has another size.)";

inline constexpr char setConfigurations[] =
    R"(Starts with the joint vector of a scene in all slices, as older scripts do it.

Args:
    config: The scene.)";

inline constexpr char initWithPath[] = R"(Starts with a path.

Args:
    q: Shape (T, n), rad or m.
Raises:
    ArgumentError: q has another shape.)";

inline constexpr char initWithWaypoints[] = R"(Starts with waypoint i at phase time (i + 1) / waypointSlicesPerPhase.

Args:
    waypoints: Joint vectors, shape (k, n), rad or m.
    waypointSlicesPerPhase: How many waypoints each phase has.
    interpolate: Between them; False: each slice starts at the last waypoint before it.
    qHomeInterpolate: Part of the way towards home, 0 .. 1.
    verbose: Not used; older scripts pass it.
Returns:
    The slices of the waypoints.
Raises:
    ArgumentError: Waypoints of another size.)";

inline constexpr char initPhaseWithDofsPath[] = R"(Starts a phase with a path of some joints.

Args:
    t_phase: The phase.
    dofIDs: Ids of the frames of the joints.
    path: Shape (slices of the phase, dofs of the joints), rad or m.
    autoResamplePath: Interpolates a path with another number of rows.
Raises:
    ArgumentError: The path has another shape, or there is no such phase.)";

inline constexpr char initRandom[] = R"(Starts at random joint vectors; ry.rnd_seed seeds them.

Args:
    verbose: Not used; older scripts pass it.)";

inline constexpr char updateRootObjects[] =
    R"(Takes over the constant poses of a scene, and its q as the one that the motion begins from. The path stays, for a
warm start; targets of objectives stay, too.

Args:
    config: The scene, with the frames and joints that the problem was made from.
Raises:
    ArgumentError: The scene has other frames.)";

inline constexpr char checkMotion[] =
    R"(Where the motion is not free of collisions. Between slices q goes straight, from the slice before the start on; what
hangs where is as in the slice that the motion begins in, so that attached objects move along. All times count, and not
just samples of them.

Args:
    margin: How near is too near, m.
    tolerance: Pairs within margin + tolerance may count, m; > 0.
Returns:
    A PathContact for each slice that the motion does not reach freely: the first pair to come too near on the way.
Raises:
    ArgumentError: A margin or tolerance that makes no sense.
    Error: There is no path yet.)";

inline constexpr char isFree[] =
    R"(Whether the motion is free of collisions at all times, straight in q from slice to slice; checkMotion says where not.

Args:
    margin: How far all pairs keep apart, m.
Returns:
    True if no pair comes nearer.
Raises:
    ArgumentError: A margin that is not finite.
    Error: There is no path yet.)";

}  // namespace kinegraph::python::docs::komo_path
