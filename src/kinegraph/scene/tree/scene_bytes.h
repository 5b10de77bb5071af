#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline scene_internal {

/// Serializes a scene to bytes: frames in order, joints with q, shapes with their meshes (shared ones once), inertias
/// and attributes, all numbers bit-exact. Writes the meshes themselves, not their file names. Intended for processes
/// that run the same version; save long-lived scenes as `.g`.
std::string sceneToBytes(const SceneTree& scene);

/// Restores a scene written by sceneToBytes. Throws ValueError for other bytes or those of another version.
std::shared_ptr<SceneTree> sceneFromBytes(std::string_view bytes);

}  // namespace kinegraph::inline scene_internal
