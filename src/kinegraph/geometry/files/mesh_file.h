#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline geometry_internal {

/// Reads a mesh file (stl, obj, ply, dae, glb and other formats of assimp) as one mesh, with node transforms applied
/// and a color per vertex from vertex colors or materials. Vertices of a part with equal positions, colors and texture
/// coordinates are joined. Ignores the up axis of a Collada file. Reads the group "mesh" of an HDF5 file (h5),
/// MuJoCo's format from a .msh file, and the reference's from a .tri file. Appends the paths of all files that it opens
/// to `files`. Throws FileError for files that are missing, unreadable, truncated, without vertices or with non-finite
/// coordinates, and for Git LFS pointers.
Mesh readMeshFile(const std::string& path, std::vector<std::string>* files = nullptr);

/// Reads an STL text or binary file from its bytes; `path` names it in messages. Bytes behind the last triangle are
/// ignored. Throws FileError.
Mesh readStlMesh(std::string_view bytes, const std::string& path);

/// Returns the content of a file. Throws FileError.
std::string readMeshBytes(const std::string& path);

/// Reads a group of an HDF5 file: `vertices` (n x 3), and optionally `faces` (m x 3), `colors` (n x 3 or n x 4, 0..255)
/// and `parts` (first vertices of its convex parts). Throws FileError.
Mesh readH5Mesh(const std::string& path, const std::string& group);

/// Reads MuJoCo's binary format: the counts of vertices, normals, texture coordinates and faces (int32), then these
/// arrays, as float32 and int32. Throws FileError.
Mesh readMshMesh(const std::string& path);

/// Reads the reference's text format: `TRI`, the counts of vertices and triangles, then three numbers for each. Throws
/// FileError.
Mesh readTriMesh(const std::string& path);

}  // namespace kinegraph::inline geometry_internal
