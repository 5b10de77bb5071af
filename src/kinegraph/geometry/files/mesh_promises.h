#pragma once

#include <string>

namespace kinegraph {

/// Headers of mesh files say how much follows, and readers believe them. Throws FileError for a file (ply, dae, gltf,
/// glb) that promises more vertices, faces or numbers than its bytes, and those of the files that it names, can hold.
void checkMeshPromises(const std::string& path);

}  // namespace kinegraph
