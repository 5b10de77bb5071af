#pragma once

#include <memory>
#include <string>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline geometry_internal {

/// Reads a mesh file as readMeshFile does, and scales it. Repeated calls return the same mesh while the file and the
/// files that it refers to are unchanged. The meshes used last are kept, up to 256 MB. Thread-safe. Throws FileError.
std::shared_ptr<const Mesh> sharedMeshFile(const std::string& path, const Vector3d& scale = Vector3d::Ones());

}  // namespace kinegraph::inline geometry_internal
