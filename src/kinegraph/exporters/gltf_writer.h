#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Converts the scene in its current state to a binary glTF 2.0 file (.glb). Each frame becomes a node with its name,
/// its pose in the parent, and the surface or points shown by a viewer, in their colors. The root node `scene` rotates
/// z to y, glTF's up axis. Shapes with the same mesh share its data. Markers, cameras and lines are omitted.
std::string gltfBytes(const Config& config);

/// Writes gltfBytes() to a file. Throws FileError.
void writeGltf(const Config& config, const std::string& path);

}  // namespace kinegraph
