#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

/// Everything that a scene holds as bytes: frames in order, joints with q, shapes with their meshes (shared ones once),
/// inertias, attributes. Numbers keep all their bits. Meshes are written, not the files that they came from. For
/// handing a scene to another process of the same version; files that people keep are written as `.g`.
std::string sceneToBytes(const SceneTree& scene);

/// The scene that sceneToBytes wrote. Throws ValueError for bytes that it did not write, or another version of it.
std::shared_ptr<SceneTree> sceneFromBytes(std::string_view bytes);

}  // namespace kinegraph
