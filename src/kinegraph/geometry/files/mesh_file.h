#pragma once

#include <string>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph {

/// Reads a mesh file (stl, obj, ply, dae, glb and whatever else assimp knows) as one mesh, node transforms applied,
/// with a color per vertex from vertex colors or materials. An up axis that a Collada file names does not turn it. Of
/// an HDF5 file (h5), the group "mesh". A .msh file is one of MuJoCo's. Throws FileError for files that are missing,
/// unreadable, without vertices or with coordinates that are not finite.
Mesh readMeshFile(const std::string& path);

/// A group of an HDF5 file: `vertices` (n x 3), and `faces` (m x 3), `colors` (n x 3 or n x 4, 0..255) and
/// `parts` (where its convex parts begin) if it has them. Throws FileError.
Mesh readH5Mesh(const std::string& path, const std::string& group);

/// MuJoCo's own binary format: the counts of vertices, normals, texture coordinates and faces (int32), then these, as
/// float32 and int32. Throws FileError.
Mesh readMshMesh(const std::string& path);

}  // namespace kinegraph
