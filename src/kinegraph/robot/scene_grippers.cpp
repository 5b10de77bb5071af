#include "kinegraph/robot/scene_grippers.h"

#include "kinegraph/geometry/shapes/cells.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline robot_internal {

namespace {

/// Returns the frame that names a gripper.
std::string nameOf(const FrameData& joint) {
  const FrameData* head = joint.parent;
  while (head->parent && !head->joint) head = head->parent;
  std::vector<const FrameData*> open = {head};
  while (!open.empty()) {
    const FrameData* frame = open.back();
    open.pop_back();
    if (frame->name.ends_with("gripper")) return frame->name;
    for (auto child = frame->children.rbegin(); child != frame->children.rend(); ++child) {
      if (!(*child)->joint) open.push_back(*child);
    }
  }
  return joint.name;
}

bool differs(const Pose& a, const Pose& b) { return !(a.inverse() * b).isIdentity(1e-12); }

}  // namespace

std::vector<SceneGripper> findGrippers(const Config& config) {
  std::vector<SceneGripper> grippers;
  for (HandFingers& hand : handFingersOf(config)) {
    if (hand.maxWidth() == 0. && hand.per_position == 0.) continue;
    const FrameData& frame = *config.scene()->find(hand.joint);
    SceneGripper gripper;
    gripper.joint = hand.joint;
    gripper.fingers = hand.fingers;
    gripper.info.name = nameOf(frame);
    double per_position = hand.per_position;
    if (hand.q.size() > 0) {
      gripper.info.min_width = hand.minWidth();
      gripper.info.max_width = hand.maxWidth();
      if (per_position == 0.)
        per_position = (hand.maxWidth() - hand.minWidth()) / (hand.q[hand.q.size() - 1] - hand.q[0]);
    }
    const Node* node = frame.attributes->find("ctrl_limits");
    const NumberArray* limits = node ? node->value.as<NumberArray>() : nullptr;
    if (limits && limits->numbers.size() > 0 && limits->numbers[0] > 0.)
      gripper.info.max_speed = per_position * limits->numbers[0];
    if (limits && limits->numbers.size() > 1 && limits->numbers[1] > 0.) gripper.info.max_force = limits->numbers[1];
    gripper.opening = std::move(hand);
    grippers.push_back(std::move(gripper));
  }
  return grippers;
}

void copyMotion(const Config& from, Config& to) {
  const bool same_q = from.getJointNames() == to.getJointNames();
  if (same_q) to.setJointState(from.getJointState());
  for (const auto& frame : from.scene()->frames()) {
    FrameData* other = to.scene()->find(frame->name);
    if (!other) continue;
    const bool moves = frame->moves() && !frame->joint->mimic;
    if (moves && other->moves() && other->joint->dofs() == frame->joint->dofs()) {
      if (!(same_q && frame->joint->active) && other->joint->q != frame->joint->q)
        to.setJointState(frame->joint->q, {frame->name});
    } else if (!frame->parent || (frame->joint && !frame->joint->dofs()) || !other->parent ||
               frame->parent->name != other->parent->name) {
      const Pose pose = from.scene()->worldPose(*frame);
      if (differs(pose, to.scene()->worldPose(*other))) Frame(to.scene(), *other).setPose(pose);
    }
  }
}

void copyRelativePoses(const Config& from, Config& to, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const FrameData* frame = from.scene()->find(name);
    FrameData* other = to.scene()->find(name);
    if (!frame || !other || frame->joint || other->joint || !frame->parent || !other->parent) continue;
    if (frame->parent->name == other->parent->name && differs(frame->pose, other->pose))
      Frame(to.scene(), *other).setRelativePose(frame->pose);
  }
}

int copyNewFrames(const Config& from, Config& to) {
  std::vector<std::pair<const FrameData*, FrameData*>> copies;
  SceneTree& tree = *to.scene();
  for (const auto& frame : from.scene()->frames()) {
    if (tree.find(frame->name)) continue;
    if (frame->shape && frame->shape->geometry->type == kCells) continue;  // a map of beliefs is no body
    FrameData& copy = tree.add(frame->name, frame->parent ? tree.find(frame->parent->name) : nullptr);
    copy.pose = frame->pose;
    copy.joint = frame->joint;
    if (copy.joint) copy.joint->active = false;
    copy.shape = frame->shape;
    copy.inertia = frame->inertia;
    copy.attributes = frame->attributes;
    copies.emplace_back(frame.get(), &copy);
  }
  for (const auto& [frame, copy] : copies) {  // after all frames exist
    if (copy->joint && copy->joint->mimic) copy->joint->mimic = tree.find(frame->joint->mimic->name);
    for (const FrameData* other : frame->no_contact) {
      if (FrameData* known = tree.find(other->name)) copy->no_contact.push_back(known);
    }
  }
  if (!copies.empty()) tree.structureChanged();
  return int(copies.size());
}

Frame headOfLink(const Frame& frame) {
  FrameData* head = &frame.data();
  while (!head->joint && head->parent) head = head->parent;
  return Frame(frame.scene(), *head);
}

}  // namespace kinegraph::inline robot_internal
