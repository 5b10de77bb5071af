#include "kinegraph/scene/floating_base.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline scene_internal {

void checkFloatingRoot(const SceneTree& scene, const std::string& path) {
  const FrameData* root = nullptr;
  for (const auto& frame : scene.frames()) {
    if (frame->parent) continue;
    if (root)
      throw ValueError(cat("addFile: `floating` needs a single root frame; '", path, "' has '", root->name, "' and '",
                           frame->name, "'"));
    root = frame.get();
  }
  if (!root || root->joint || root->name == "world")
    throw ValueError(cat("addFile: `floating` needs a root frame that can move; that of '", path, "' is ",
                         root ? cat("'", root->name, "'") : "missing", ". In MJCF a <freejoint/> lets a body float"));
}

void makeFloating(Frame frame, const std::string& prefix) {
  FrameData* root = &frame.data();
  while (root->parent) root = root->parent;
  const auto& scene = frame.scene();
  const std::string name = cat(prefix, "world");
  FrameData& world = scene->add(scene->find(name) ? cat(root->name, "_world") : name, nullptr);
  Frame(scene, *root).setParent(Frame(scene, world)).setJoint(JointType::free);
}

}  // namespace kinegraph::inline scene_internal
