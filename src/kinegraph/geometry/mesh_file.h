#pragma once

#include <string>

#include "kinegraph/geometry/geometry.h"

namespace kinegraph {

/// Reads a mesh file (stl, obj, ply, dae, glb and whatever else assimp knows) as one mesh, node transforms applied, with
/// a colour per vertex from vertex colours or materials. Throws FileError for files that
/// are missing, unreadable, without vertices or with coordinates that are not finite.
Mesh readMeshFile(const std::string& path);

}  // namespace kinegraph
