#pragma once

namespace kinegraph::python::docs::roadmap {

inline constexpr char type[] = R"(A graph of configurations and edges that is kept from query to query (lazy PRM).

    map = ry.Roadmap(C, margin=.01).grow(500)
    answer = map.findPath(q0, q1)
    map.save("arm.roadmap")

An edge is checked continuously when a query first uses it, and the result is kept. Paths are the shortest ones of the
graph, then shortened by shortcuts. Equal calls give equal bits.)";

inline constexpr char make[] = R"(Creates a roadmap without configurations.

Args:
    config: The scene, as it is now.
    margin: Distance that all collidable pairs keep, m.
    seed: Seed of the samples.
Raises:
    ArgumentError: A joint has no limits, or the margin is negative.)";

inline constexpr char grow[] = R"(Adds collision-free random configurations, each with edges to the nearest ones.

Args:
    configurations: Number of configurations.
Returns:
    This roadmap.
Raises:
    ArgumentError: The number is negative.)";

inline constexpr char findPath[] = R"(Finds a path; start and goal become configurations of the roadmap.

Args:
    start: A joint vector, shape (n,), rad or m.
    goal: A joint vector, shape (n,), rad or m.
Returns:
    A RoadmapPath: path, shape (K, n), continuously collision-free. If there is none, its message says why.
Raises:
    ArgumentError: A joint vector has another length.)";

inline constexpr char setScene[] =
    R"(Replaces the scene by another one with the same joints, for example after obstacles have moved. Drops the
results of edge checks; the configurations stay.

Args:
    config: The scene, as it is now.
Raises:
    ArgumentError: It has other joints.)";

inline constexpr char save[] = R"(Writes the roadmap to a file.

Args:
    path: The file.
Raises:
    FileError: It cannot be written.)";

inline constexpr char load[] =
    R"(Replaces this roadmap by a saved one. Results of edge checks are kept only if the scene is the same.

Args:
    path: A file that save has written.
Raises:
    FileError: The file is missing or damaged.
    ArgumentError: It is a roadmap of other joints.)";

inline constexpr char picture[] =
    R"(Returns a copy of the scene with the traces of frames along the edges as lines: "roadmap".

Args:
    config: The scene.
)";

}  // namespace kinegraph::python::docs::roadmap
