#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// The scene, as it stands, as a binary glTF 2.0 file (.glb): a node per frame, with its name and its pose in the
/// parent, and the surface, or points, that a viewer shows for it, in its colors. All hangs on a node `scene` that
/// turns the z axis into the y axis, which is up in glTF. Shapes of one mesh share its numbers. Markers, cameras and
/// lines are left out.
std::string gltfBytes(const Config& config);

/// Writes that into a file. Throws FileError.
void writeGltf(const Config& config, const std::string& path);

}  // namespace kinegraph
