#include "kinegraph/komo/path/initial_configuration.h"

#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline komo_internal {

InitialConfiguration::InitialConfiguration(const Config& config)
    : tree(config.scene()->snapshot()),
      model(config.model()),
      parameters(config.parameters()),
      q(config.getJointState()),
      source_(config.scene()) {
  for (const auto& frame : config.scene()->frames()) {
    if (!frame->moves() || !frame->joint->active || frame->joint->mimic) continue;
    joint_frames.push_back(frame->id);
    if (frame->joint->stable) shared_joints.insert(frame->id);
  }
}

Config InitialConfiguration::config() const {
  Config copy(*tree);
  copy.setJointState(q);
  restoreAttributes(copy);
  return copy;
}

void InitialConfiguration::restoreAttributes(Config& copy) const {
  const auto& frames = copy.scene()->frames();
  for (const auto& source : source_->frames()) {
    if (source->id < int(frames.size()) && frames[source->id]->name == source->name)
      frames[source->id]->attributes = source->attributes;
  }
}

void InitialConfiguration::transferPoses(const Config& config) {
  const auto copy = std::make_shared<SceneTree>();
  copy->append(*tree, {}, false);
  kinegraph::transferPoses(*copy, config);
  tree = copy;
  parameters = config.parameters();
}

void transferPoses(SceneTree& target, const Config& config) {
  for (const auto& source : config.scene()->frames()) {
    FrameData& frame = *target.frames()[source->id];
    const int parent = source->parent ? source->parent->id : -1, parent_here = frame.parent ? frame.parent->id : -1;
    if (!source->moves() && !frame.moves() && parent == parent_here) frame.pose = source->pose;
  }
  target.posesChanged();
}

}  // namespace kinegraph::inline komo_internal
