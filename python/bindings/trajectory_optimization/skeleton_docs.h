#pragma once

/// Docstrings of the functions in bind_skeleton.cpp.
namespace kinegraph::python::docs::skeleton {

inline constexpr char addEntry[] = R"(Adds an entry: a mode or constraint and its time interval.

Args:
    timeInterval: [at] or [from, to], phase times; to = -1 is the end, or, for attachments such as SY.stable, the
        next attachment of the object.
    symbol: A symbol of SY.
    frames: Names of its frames: [gripper, object] for touch, [parent, object] for stable, stableOn, ...
Raises:
    ArgumentError: The times, the symbol or the number of frames is invalid.)";

inline constexpr char add[] = R"(Adds entries from a flat list.

Args:
    entries: Times, symbol, frames, times, symbol, frames ...
Raises:
    ArgumentError: The list has another form.)";

inline constexpr char addExplicitCollisions[] = R"(Adds pairs of frames that must not overlap.

Args:
    collisions: Their names, two consecutive ones per pair.
Raises:
    ArgumentError: The number of names is odd.)";

inline constexpr char addLiftPriors[] =
    R"(Adds objects that paths lift above 0.6 m in the middle of each phase, as a soft constraint.

Args:
    lift: Their names.
Raises:
    FrameNotFound: By the calls that make a KOMO: a frame is not in the scene.)";

inline constexpr char useBroadCollisions[] =
    R"(Enables or disables collision avoidance of all pairs. It is enabled initially.

Args:
    enable: False avoids collisions of the pairs of addExplicitCollisions only.)";

inline constexpr char getKomo_path[] =
    R"(Makes a KOMO of a path, 5 s per phase, with costs on accelerations and on the distance from home.

Args:
    Configuration: The scene.
    stepsPerPhase: Slices per phase.
    accScale: Scale of the costs on accelerations; 0 omits them.
    lenScale: Ignored; accepted for older scripts.
    homingScale: Scale of the costs on the distance from home; 0 omits them.
    collScale: Ignored; accepted for older scripts.
Returns:
    The KOMO.
Raises:
    FrameNotFound: A frame of an entry is not in the scene.)";

inline constexpr char getKomo_waypoints[] =
    R"(Makes a KOMO of one slice per phase, with costs on the distances between slices and from home.

Args:
    Configuration: The scene.
    lenScale: Scale of the costs on the distances between slices; 0 omits them.
    homingScale: Scale of the costs on the distance from home; 0 omits them.
    collScale: Ignored; accepted for older scripts.
Returns:
    The KOMO.
Raises:
    FrameNotFound: A frame of an entry is not in the scene.)";

inline constexpr char getKomo_finalSlice[] =
    R"(Makes a KOMO of two slices: the end, and before it one in which all objects held at the end were grasped.

Args:
    Configuration: The scene.
    lenScale: Scale of the costs on the distance between the slices; 0 omits them.
    homingScale: Scale of the costs on the distance from home; 0 omits them.
    collScale: Ignored; accepted for older scripts.
Returns:
    The KOMO.
Raises:
    FrameNotFound: A frame of an entry is not in the scene.)";

inline constexpr char getTwoWaypointProblem[] =
    R"(Returns the input for planning the motion between two solved waypoints.

Args:
    t2: The phase of the motion.
    komoWays: A solved KOMO from getKomo_waypoints.
Returns:
    The scene in this phase, q before it, shape (n,), and q at its end, shape (n,).
Raises:
    ArgumentError: The phase does not exist.)";

inline constexpr char setSkeleton[] = R"(Adds the entries of a Skeleton to this problem.

Args:
    skeleton: The Skeleton, or a flat list as for Skeleton.add.
Raises:
    ArgumentError: An entry is makeFree, which changes the scene, or the list has another form.
    FrameNotFound: A frame of an entry is not in the scene.)";

}  // namespace kinegraph::python::docs::skeleton
