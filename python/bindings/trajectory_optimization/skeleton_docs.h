#pragma once

/// The manual of what bind_skeleton.cpp binds.
namespace kinegraph::python::docs::skeleton {

inline constexpr char addEntry[] = R"(Adds an entry: what shall hold when.

Args:
    timeInterval: [at] or [from, to] in phases; to = -1: until the end, or, of attachments such as SY.stable, until
        the next one of the object.
    symbol: Of SY.
    frames: Names of those that it is about: [gripper, object] for touch, [parent, object] for stable, stableOn, ...
Raises:
    ArgumentError: Not times, not a symbol, or not as many frames as the symbol has.)";

inline constexpr char add[] = R"(Adds entries from a flat list.

Args:
    entries: Times, symbol, frames, times, symbol, frames ...
Raises:
    ArgumentError: The list does not go on like that.)";

inline constexpr char addExplicitCollisions[] = R"(Adds pairs of frames that never overlap.

Args:
    collisions: Their names, two by two.
Raises:
    ArgumentError: An odd number of names.)";

inline constexpr char addLiftPriors[] =
    R"(Adds objects that rise above 0.6 m in the middle of each phase of a path, if nothing else matters more.

Args:
    lift: Their names.
Raises:
    FrameNotFound: By the calls that make a KOMO: a name that is not in the scene.)";

inline constexpr char useBroadCollisions[] =
    R"(Sets whether the motion is kept free of all collisions. A new Skeleton keeps it free.

Args:
    enable: False: only the pairs of addExplicitCollisions are kept apart.)";

inline constexpr char getKomo_path[] =
    R"(A KOMO of a path, 5 s per phase, with costs on accelerations and on the distance from home.

Args:
    Configuration: The scene.
    stepsPerPhase: Slices per phase.
    accScale: Scale of the costs on accelerations; 0 leaves them out.
    lenScale: Not used; older scripts pass it.
    homingScale: Scale of the costs on the distance from home; 0 leaves them out.
    collScale: Not used; older scripts pass it.
Returns:
    The KOMO.
Raises:
    FrameNotFound: A name of an entry that is not in the scene.)";

inline constexpr char getKomo_waypoints[] =
    R"(A KOMO of one slice per phase, with costs on the distances cancellation them and from home.

Args:
    Configuration: The scene.
    lenScale: Scale of the costs on the distances cancellation slices; 0 leaves them out.
    homingScale: Scale of the costs on the distance from home; 0 leaves them out.
    collScale: Not used; older scripts pass it.
Returns:
    The KOMO.
Raises:
    FrameNotFound: A name of an entry that is not in the scene.)";

inline constexpr char getKomo_finalSlice[] =
    R"(A KOMO of two slices: the second is the end; in the first, all objects were taken that are held at the end.

Args:
    Configuration: The scene.
    lenScale: Scale of the costs on the distance cancellation the slices; 0 leaves them out.
    homingScale: Scale of the costs on the distance from home; 0 leaves them out.
    collScale: Not used; older scripts pass it.
Returns:
    The KOMO.
Raises:
    FrameNotFound: A name of an entry that is not in the scene.)";

inline constexpr char getTwoWaypointProblem[] =
    R"(What is needed to plan the motion cancellation two waypoints that are solved.

Args:
    t2: The phase in which the motion is.
    komoWays: Of getKomo_waypoints, solved.
Returns:
    The scene in that phase, q before it, shape (n,), and q at its end, shape (n,).
Raises:
    ArgumentError: There is no such phase.)";

inline constexpr char setSkeleton[] = R"(Adds the entries of a Skeleton to this problem.

Args:
    skeleton: The Skeleton, or a flat list as for Skeleton.add.
Raises:
    ArgumentError: An entry of makeFree, which changes the scene, or a list that is none of entries.
    FrameNotFound: A name of an entry that is not in the scene.)";

}  // namespace kinegraph::python::docs::skeleton
