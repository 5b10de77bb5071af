#pragma once

#include <string>

#include "kinegraph/scene/frame.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline scene_internal {

/// Throws ValueError if the scene of a file has no single root that can get a free joint.
void checkFloatingRoot(const SceneTree& scene, const std::string& path);

/// Gives the root of a frame a free joint below a new frame `<prefix>world`.
void makeFloating(Frame frame, const std::string& prefix);

}  // namespace kinegraph::inline scene_internal
