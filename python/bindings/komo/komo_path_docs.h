#pragma once

/// Docstrings of the functions in bind_komo_path.cpp.
namespace kinegraph::python::docs::komo_path {

inline constexpr char getPath[] = R"(Returns the joint vectors of all slices.

Args:
    dofIndices: Ids of frames, to return only the dofs of their joints; [] for all.
Returns:
    Shape (T, n), rad or m.
Raises:
    ArgumentError: A frame has no active joint.)";

inline constexpr char getFrameState[] = R"(Returns world poses of all frames in a slice.

Args:
    t: The slice.
Returns:
    Shape (frames, 7): x y z (m) qw qx qy qz.
Raises:
    ArgumentError: The slice does not exist.)";

inline constexpr char getFrame[] = R"(Returns a frame as it is in a slice.

Args:
    frameName: Name of the frame.
    phaseTime: Phase time of the slice.
Returns:
    A copy of the frame.
Raises:
    FrameNotFound: The frame is not in the scene.)";

inline constexpr char getConfiguration[] = R"(Returns the scene in a slice.

Args:
    t: The slice; -1 is the one before the first.
Returns:
    A copy.
Raises:
    ArgumentError: The slice does not exist.)";

inline constexpr char getSubProblem[] =
    R"(Returns the input for planning the motion of a phase, for a KOMO with one slice per phase.

Args:
    phase: The phase.
Returns:
    The scene at the beginning of the phase, q at its beginning, shape (n,), and q at its end, shape (n,).
Raises:
    ArgumentError: The phase does not exist.)";

inline constexpr char getForceInteractions[] =
    R"(Returns the contact forces, a dict per force and slice: `from` pushes `onto` at `poa` (m) with `force` (N), both
of shape (3,), in the world.)";

inline constexpr char initWithConstant[] = R"(Initializes all slices with one joint vector.

Args:
    q: Shape (n,), rad or m.
Raises:
    ArgumentError: q has another size.)";

inline constexpr char setConfigurations[] =
    R"(Initializes all slices with the joint vector of a scene, for older scripts.

Args:
    config: The scene.)";

inline constexpr char initWithPath[] = R"(Initializes the path.

Args:
    q: Shape (T, n), rad or m.
Raises:
    ArgumentError: q has another shape.)";

inline constexpr char initWithWaypoints[] =
    R"(Initializes the path with waypoint i at phase time (i + 1) / waypointSlicesPerPhase.

Args:
    waypoints: Joint vectors, shape (k, n), rad or m.
    waypointSlicesPerPhase: Number of waypoints per phase.
    interpolate: True interpolates between waypoints, False repeats each until the next one.
    qHomeInterpolate: Pulls the middle of each interpolation towards home, 0 .. 1.
    verbose: Ignored; accepted for older scripts.
Returns:
    The slices of the waypoints.
Raises:
    ArgumentError: A waypoint has another size.)";

inline constexpr char initPhaseWithDofsPath[] = R"(Initializes some joints in a phase with a path.

Args:
    t_phase: The phase.
    dofIDs: Ids of the frames of the joints.
    path: Shape (slices of the phase, dofs of the joints), rad or m.
    autoResamplePath: True interpolates a path with another number of configurations.
Raises:
    ArgumentError: The path has another shape, or the phase does not exist.)";

inline constexpr char initRandom[] = R"(Initializes the path with random joint vectors; ry.rnd_seed seeds them.

Args:
    verbose: Ignored; accepted for older scripts.)";

inline constexpr char updateRootObjects[] =
    R"(Copies the constant poses of a scene, and uses its q as the start of the motion.

The path remains as a warm start, and the targets of objectives do not change.

Args:
    config: The scene, with the frames and joints that the problem was made from.
Raises:
    ArgumentError: The scene has other frames.)";

inline constexpr char checkMotion[] =
    R"(Checks continuously that the motion between slices is collision-free.

Between slices q moves linearly, from the slice before the first on. The kinematic structure is that of the slice in
which a motion begins, so attached objects move along.

Args:
    margin: Closer pairs count as contacts, m.
    tolerance: Pairs within margin + tolerance may count, m; > 0.
Returns:
    A PathContact for each slice that the motion does not reach collision-free: the first pair to come too close.
Raises:
    ArgumentError: The margin or the tolerance is invalid.
    Error: The scene or the timing is missing.)";

inline constexpr char isFree[] =
    R"(Returns whether the motion is continuously collision-free, with q linear between slices; see checkMotion.

Args:
    margin: Minimum distance of all pairs, m.
Returns:
    True if no pair comes closer.
Raises:
    ArgumentError: The margin is not finite.
    Error: The scene or the timing is missing.)";

}  // namespace kinegraph::python::docs::komo_path
