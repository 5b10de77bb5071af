#include "kinegraph/robot/scene_grippers.h"

#include <cmath>

namespace kinegraph {

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
  for (const auto& frame : config.scene()->frames()) {
    const auto& joint = frame->joint;
    if (!joint || joint->active || joint->mimic || joint->dofs() != 1 || !frame->parent) continue;
    SceneGripper gripper;
    gripper.opening = 0.;
    for (const auto& other : config.scene()->frames()) {
      if (!other->moves() || &dofSource(*other) != frame.get()) continue;
      gripper.opening += std::abs(motionScale(*other));
      gripper.fingers.push_back(other->name);
    }
    if (gripper.fingers.size() < 2 || gripper.opening == 0.) continue;
    gripper.joint = frame->name;
    gripper.info.name = nameOf(*frame);
    if (joint->lower.size() == 1) {
      gripper.info.min_width = gripper.opening * joint->lower[0];
      gripper.info.max_width = gripper.opening * joint->upper[0];
    }
    const Node* node = frame->attributes->find("ctrl_limits");
    const NumberArray* limits = node ? node->value.as<NumberArray>() : nullptr;
    if (limits && limits->numbers.size() > 0 && limits->numbers[0] > 0.)
      gripper.info.max_speed = gripper.opening * limits->numbers[0];
    if (limits && limits->numbers.size() > 1 && limits->numbers[1] > 0.) gripper.info.max_force = limits->numbers[1];
    grippers.push_back(gripper);
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

int copyNewFrames(const Config& from, Config& to) {
  std::vector<std::pair<const FrameData*, FrameData*>> copies;
  SceneTree& tree = *to.scene();
  for (const auto& frame : from.scene()->frames()) {
    if (tree.find(frame->name)) continue;
    FrameData& copy = tree.add(frame->name, frame->parent ? tree.find(frame->parent->name) : nullptr);
    copy.pose = frame->pose;
    copy.joint = frame->joint;
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

}  // namespace kinegraph
