#include "kinegraph/scene/tree/tree_edits.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline scene_internal {

namespace {

/// Returns whether negating the dofs inverts every motion of this joint.
bool inverseIsNegative(const Joint& joint) {
  const auto slides = [](const MotionStep& step) { return step.translates(); };
  return joint.dofs() <= 1 || std::all_of(joint.steps.begin(), joint.steps.end(), slides);
}

std::string quoted(const FrameData& frame) { return cat("frame '", frame.name, "'"); }

/// The inverse of the joint of `frame`. `relative` is its current relative pose.
Joint inverseJoint(const FrameData& frame, const Pose& relative) {
  Joint joint = *frame.joint;
  if (joint.type == JointType::tau) return joint;
  if (inverseIsNegative(joint)) {
    joint.q = -joint.q;
    joint.home = -joint.home;
    const VectorXd lower = joint.lower;
    joint.lower = -joint.upper;
    joint.upper = -lower;
    return joint;
  }
  if (!hasInverses(joint.type) || joint.mimic) {
    throw ValueError(cat("makeRoot: the ", jointTypeName(joint.type), " joint of ", quoted(frame),
                         joint.mimic ? " mimics another and" : "", " cannot be inverted"));
  }
  if (joint.lower.size() > 0) {
    throw ValueError(cat("makeRoot: the limits of the ", jointTypeName(joint.type), " joint of ", quoted(frame),
                         " have no counterpart in its inverse; remove them first"));
  }
  const Pose home = motionPose(joint.steps, joint.axis, joint.scale, joint.home.data());
  joint.q = motionProject(joint.steps, joint.axis, joint.scale, relative.inverse());
  joint.home = motionProject(joint.steps, joint.axis, joint.scale, home.inverse());
  return joint;
}

bool isPartBreak(const FrameData& frame) {
  return frame.joint && !frame.joint->mimic &&
         (frame.joint->type == JointType::rigid || frame.joint->type == JointType::free);
}

}  // namespace

void makeRoot(SceneTree& scene, FrameData& frame, bool until_part_break) {
  std::vector<FrameData*> path = {&frame};  // from the new root to the old one
  while (path.back()->parent && !(until_part_break && isPartBreak(*path.back()))) path.push_back(path.back()->parent);
  const Pose world = frame.worldPose();
  std::vector<Pose> inverse_pose;
  std::vector<std::optional<Joint>> inverse_joint;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Pose relative = path[i]->relativePose();
    inverse_pose.push_back(relative.inverse());
    inverse_joint.push_back(path[i]->joint ? std::optional(inverseJoint(*path[i], relative)) : std::nullopt);
  }
  for (const auto& other : scene.frames()) {  // joints that mimic a negated q
    if (!other->joint || !other->joint->mimic || std::find(path.begin(), path.end(), other.get()) != path.end())
      continue;
    const auto source = std::find(path.begin(), path.end() - 1, &dofSource(*other));
    if (source != path.end() - 1 && !inverseIsNegative(*(*source)->joint)) {
      throw ValueError(cat("makeRoot: ", quoted(*other), " mimics the ", jointTypeName((*source)->joint->type),
                           " joint of ", quoted(**source), "; that joint cannot be inverted while another mimics it"));
    }
  }

  const std::size_t joints = path.size() - 1;
  const auto place = [&](const FrameData* of) {
    return std::size_t(std::find(path.begin(), path.begin() + joints, of) - path.begin());
  };
  struct Follower {
    Joint* joint;
    bool changes_sign;  // whether exactly one of the joint and its source is inverted
  };
  std::vector<Follower> followers;
  for (const auto& other : scene.frames()) {
    if (!other->joint || !other->joint->mimic) continue;
    const std::size_t own = place(other.get());
    const bool source_turns = place(&dofSource(*other)) < joints;
    followers.push_back({own < joints ? &*inverse_joint[own] : &*other->joint, source_turns != (own < joints)});
  }
  for (const auto& [joint, changes_sign] : followers) {
    if (changes_sign) joint->scale = -joint->scale;
    if (const std::size_t source = place(joint->mimic); source < joints) joint->mimic = path[source + 1];
  }

  for (FrameData* part : path) {
    if (part->parent) scene.unlink(*part);
    part->joint.reset();
  }
  frame.pose = world;
  for (std::size_t i = 0; i < joints; ++i) {
    FrameData& below = *path[i + 1];
    scene.link(below, *path[i]);
    below.pose = inverse_pose[i];
    below.joint = std::move(inverse_joint[i]);
  }
  scene.structureChanged();
}

void selectJointsBySubtree(SceneTree& scene, const FrameData& root) {
  for (const auto& frame : scene.frames()) {
    if (!frame->moves() || frame->joint->mimic) continue;
    const FrameData* above = frame.get();
    while (above && above != &root) above = above->parent;
    frame->joint->active = above != nullptr;
  }
  scene.structureChanged();
}

int dofIndex(SceneTree& scene, const FrameData& frame) {
  if (!frame.joint) throw ValueError(cat(quoted(frame), " has no joint, so it has no index in q"));
  const FrameData& source = dofSource(frame);
  if (source.joint->active && source.moves()) return scene.model()->frame_dofs[source.id].first;
  int first = 0;
  for (const auto& other : scene.frames()) {
    if (other.get() == &source) break;
    if (other->moves() && !other->joint->mimic && other->joint->active == source.joint->active)
      first += other->joint->dofs();
  }
  return first;
}

namespace {

void requireFreeParent(const FrameData& frame) {
  const auto refuse = [&](const std::string& why) {
    throw ValueError(cat("recalibrateJointsToZero: ", quoted(frame), " ", why));
  };
  if (frame.joint->dofs() != 1)
    refuse(cat("has a ", jointTypeName(frame.joint->type), " joint; only joints of one dof have a zero to move"));
  const FrameData& parent = *frame.parent;
  if (!parent.parent) refuse(cat("hangs below '", parent.name, "', a root; put a frame between them"));
  if (parent.shape || parent.inertia || parent.joint) {
    refuse(cat("hangs below '", parent.name, "', which has a ",
               parent.shape   ? "shape"
               : parent.joint ? "joint"
                              : "mass",
               "; put an empty frame between them"));
  }
  for (const FrameData* sibling : parent.children) {
    if (sibling != &frame && sibling->moves())
      refuse(cat("and '", sibling->name, "' hang below the same frame '", parent.name, "'"));
  }
}

}  // namespace

void recalibrateJointsToZero(SceneTree& scene) {
  std::vector<std::pair<FrameData*, Pose>> joints;
  for (const auto& frame : scene.frames()) {
    if (!frame->moves()) continue;
    requireFreeParent(*frame);
    joints.emplace_back(frame.get(), frame->relativePose());
  }
  for (auto& [frame, motion] : joints) {
    FrameData& parent = *frame->parent;
    parent.pose = parent.pose * motion;
    for (FrameData* sibling : parent.children) {
      if (sibling != frame) sibling->pose = motion.inverse() * sibling->pose;
    }
    Joint& joint = *frame->joint;
    if (joint.mimic) continue;
    if (joint.lower.size() > 0) {
      joint.lower -= joint.q;
      joint.upper -= joint.q;
    }
    joint.home -= joint.q;
    joint.q.setZero();
  }
  scene.structureChanged();
}

}  // namespace kinegraph::inline scene_internal
