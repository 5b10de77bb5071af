#pragma once

namespace kinegraph::python::docs::roadmap {

inline constexpr char type[] = R"(Postures and motions cancellation them that are kept from query to query.

    map = ry.Roadmap(C, margin=.01).grow(500)
    answer = map.findPath(q0, q1)
    map.save("arm.roadmap")

Motions are looked at when a query first wants to use them, at all times of them, and it is remembered what came out.
Paths are the shortest of the map, then shortened. The same calls give the same bits.)";

inline constexpr char make[] = R"(A map without postures.

Args:
    config: The scene, as it is now.
    margin: Distance that all collidable pairs keep, m.
    seed: Of the random postures.
Raises:
    ArgumentError: A joint has no limits, or the margin is negative.)";

inline constexpr char grow[] = R"(Adds free random postures, each with motions to the nearest ones.

Args:
    configurations: How many.
Returns:
    This map.
Raises:
    ArgumentError: The number is negative.)";

inline constexpr char findPath[] = R"(A path in the map; start and goal become postures of it.

Args:
    start: A joint vector, shape (n,), rad or m.
    goal: A joint vector, shape (n,), rad or m.
Returns:
    A RoadmapPath: path, shape (K, n), free at all times; where there is none, its message says why.
Raises:
    ArgumentError: A joint vector has another length.)";

inline constexpr char setScene[] =
    R"(Takes another scene with the same joints, as after obstacles have moved. Postures stay.

Args:
    config: The scene, as it is now.
Raises:
    ArgumentError: It has other joints.)";

inline constexpr char save[] = R"(Writes the map into a file.

Args:
    path: The file.
Raises:
    FileError: It cannot be written.)";

inline constexpr char load[] =
    R"(Reads a map in place of this one. What is known of motions is taken over if the scene is the same.

Args:
    path: A file that save has written.
Raises:
    FileError: The file is not there, or damaged.
    ArgumentError: It is a map of other joints.)";

inline constexpr char picture[] =
    R"(A copy of the scene with lines in it along which frames go on the map's motions: "roadmap".

Args:
    config: The scene.
)";

}  // namespace kinegraph::python::docs::roadmap
