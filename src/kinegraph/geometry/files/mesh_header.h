#pragma once

#include <string>

namespace kinegraph::inline geometry_internal {

/// Checks the element counts in the headers of mesh files, because readers allocate memory for them. Throws FileError
/// for a file (ply, dae, gltf, glb) that announces more vertices, faces or numbers than its bytes, and the bytes of the
/// files it refers to, can hold.
void checkMeshHeader(const std::string& path);

}  // namespace kinegraph::inline geometry_internal
