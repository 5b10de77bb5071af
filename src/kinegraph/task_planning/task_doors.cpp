#include "kinegraph/task_planning/task_doors.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph {

std::string TaskDoor::stateAt(double q) const {
  const double part = share(q);
  return part >= kOpened ? "opened" : part <= kClosed ? "closed" : "ajar";
}

std::vector<TaskDoor> task_planning_internal::doorsOf(const Config& C) {
  const std::vector<Literal> facts = sceneFacts(C);
  std::vector<std::string> names = wordsOf(facts, "is_door");
  for (const std::string& name : wordsOf(facts, "is_drawer"))
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  if (names.empty()) return {};
  const std::vector<std::string> joints = C.getJointNames();
  std::vector<TaskDoor> doors;
  for (const std::string& name : names) {
    const auto at = std::ranges::find(joints, name);
    if (at == joints.end()) continue;
    const Joint& joint = *C.getFrame(name).data().joint;
    if (joint.lower.size() != 1 || !(joint.lower[0] < joint.upper[0])) continue;
    const double low = joint.lower[0], high = joint.upper[0];
    const bool low_is_nearer = std::abs(low) <= std::abs(high);
    doors.push_back({name, at - joints.begin(), low_is_nearer ? low : high, low_is_nearer ? high : low});
  }
  return doors;
}

std::map<std::string, std::string> doorStates(const Config& C) {
  std::map<std::string, std::string> states;
  for (const TaskDoor& door : doorsOf(C)) states[door.name] = door.stateAt(C.getJointState()[door.dof]);
  return states;
}

bool task_planning_internal::isHold(const TaskAction& action) { return !action.empty() && action[0] == "hold"; }

bool task_planning_internal::isGuided(const TaskAction& action) {
  return !action.empty() && (action[0] == "open" || action[0] == "close");
}

Grip task_planning_internal::gripOf(const Config& C, const std::string& hand, const std::string& handle) {
  using Body = ShapeKind::Body;
  if (!opening(C, hand)) return Grip::point;
  switch (shapeKind(C.getFrame(handle).getShapeType()).body) {
    case Body::ball:
      return Grip::point;
    case Body::cylinder:
    case Body::capsule:
      return Grip::axis;
    default:
      return Grip::rigid;
  }
}

MatrixXd task_planning_internal::withSettledDoors(const Config& C, const std::vector<TaskAction>& actions,
                                                  MatrixXd waypoints) {
  const VectorXd q = C.getJointState();
  for (const TaskDoor& door : doorsOf(C)) {
    double now = q[door.dof];
    for (std::size_t i = 0; i < actions.size(); ++i) {
      double& there = waypoints(Eigen::Index(i), door.dof);
      const bool is_moved = isGuided(actions[i]) && objectOf(actions[i]) == door.name;
      if (is_moved) now = std::clamp(there, std::min(door.closed, door.open), std::max(door.closed, door.open));
      there = now;
    }
  }
  return waypoints;
}

StillDoors task_planning_internal::withStillDoors(const Config& C, const std::vector<TaskDoor>& doors) {
  StillDoors still{C, {}};
  for (Eigen::Index i = 0; i < C.getJointDimension(); ++i)
    if (std::ranges::none_of(doors, [&](const TaskDoor& door) { return door.dof == i; })) still.dofs.push_back(i);
  for (const TaskDoor& door : doors) still.scene.getFrame(door.name).data().joint->active = false;
  if (!doors.empty()) still.scene.getFrame(doors[0].name).scene()->structureChanged();
  return still;
}

std::vector<std::string> task_planning_internal::partsOf(const Config& C, const std::string& door) {
  std::vector<std::string> parts = {door};
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const Frame& child : C.getFrame(parts[i]).getChildren())
      if (child.getJointType() == JointType::none) parts.push_back(child.getName());
  return parts;
}

std::vector<std::string> task_planning_internal::movedBy(const Config& C, const std::string& door,
                                                         const std::vector<std::string>& objects) {
  std::vector<std::string> moved;
  for (const Frame& frame : C.getFrame(door).getSubtree())
    if (std::ranges::find(objects, frame.getName()) != objects.end()) moved.push_back(frame.getName());
  return moved;
}

}  // namespace kinegraph
