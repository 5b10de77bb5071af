#pragma once

#include <memory>
#include <string>

#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

/// Throws ValueError if the scene of a file has no single root that can get a free joint.
void checkFloatingRoot(const SceneTree& scene, const std::string& path);

/// Gives a root a free joint below a new frame `<prefix>world`.
void makeFloating(const std::shared_ptr<SceneTree>& scene, FrameData& root, const std::string& prefix);

}  // namespace kinegraph
