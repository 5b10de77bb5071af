#include "kinegraph/scene/tree/named_states.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline scene_internal {

namespace {

/// Calls visit(group, state, value) for all states of this frame's joint; `group` is "" outside of groups.
template <class Visit>
void forStates(const FrameData& frame, const Visit& visit) {
  const Node* node = frame.attributes->find("joint_states");
  const Graph* states = node && frame.moves() ? node->value.as<Graph>() : nullptr;
  if (!states) return;
  for (const Node& state : states->nodes) {
    if (const Graph* of_group = state.value.as<Graph>()) {
      for (const Node& inner : of_group->nodes) visit(state.key, inner.key, inner.value);
    } else {
      visit(std::string(), state.key, state.value);
    }
  }
}

void appendNew(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

VectorXd dofValues(const FrameData& frame, const std::string& state, const Value& value) {
  std::vector<double> q;
  if (const double* number = value.as<double>()) q = {*number};
  if (const NumberArray* array = value.as<NumberArray>()) q = array->numbers;
  if (int(q.size()) != frame.joint->dofs()) {
    throw ValueError(cat("joint_states of frame '", frame.name, "', state '", state, "': expected ",
                         frame.joint->dofs(), " numbers, got ", describe(value)));
  }
  return Eigen::Map<const VectorXd>(q.data(), Eigen::Index(q.size()));
}

std::vector<std::string> groupsOfStates(const SceneTree& scene) {
  std::vector<std::string> names;
  for (const auto& frame : scene.frames()) {
    forStates(*frame, [&](const std::string& group, const std::string&, const Value&) {
      if (!group.empty()) appendNew(names, group);
    });
  }
  return names;
}

void checkGroup(const SceneTree& scene, const std::string& group) {
  const std::vector<std::string> names = groupsOfStates(scene);
  if (group.empty() || std::find(names.begin(), names.end(), group) != names.end()) return;
  throw NameError(cat("no group '", group, "' has named states; available: ", names.empty() ? "none" : join(names),
                      similarHint(group, names)));
}

}  // namespace

std::vector<std::string> stateNames(const SceneTree& scene, const std::string& group) {
  checkGroup(scene, group);
  std::vector<std::string> names;
  for (const auto& frame : scene.frames()) {
    forStates(*frame, [&](const std::string& of, const std::string& name, const Value&) {
      if (group.empty() || of == group) appendNew(names, name);
    });
  }
  return names;
}

VectorXd namedState(SceneTree& scene, const std::string& name, const std::string& group) {
  checkGroup(scene, group);
  const auto model = scene.model();
  VectorXd q = scene.jointState();
  bool found = false;
  for (const auto& frame : scene.frames()) {
    std::string first_group;
    VectorXd first;
    forStates(*frame, [&](const std::string& of, const std::string& state, const Value& value) {
      if (state != name || (!group.empty() && of != group)) return;
      found = true;
      const VectorXd values = dofValues(*frame, name, value);
      if (first.size() > 0 && values != first) {
        throw ValueError(cat("state '", name, "' has two values of joint '", frame->name, "': in group '", first_group,
                             "' and in group '", of, "'; pass the group"));
      }
      first = values;
      first_group = of;
    });
    const KinematicModel::DofRange dofs = model->frame_dofs[frame->id];
    if (first.size() > 0 && dofs.count == first.size() && !frame->joint->mimic)
      q.segment(dofs.first, dofs.count) = first;
  }
  if (found) return q;
  const std::vector<std::string> names = stateNames(scene, group);
  throw NameError(cat("no state '", name, "'", group.empty() ? "" : cat(" of group '", group, "'"),
                      "; available: ", names.empty() ? "none" : join(names), similarHint(name, names)));
}

std::vector<std::pair<std::string, std::vector<std::string>>> jointGroups(const SceneTree& scene) {
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;
  for (const auto& frame : scene.frames()) {
    const Node* node = frame->attributes->find("joint_groups");
    if (!node || !frame->moves()) continue;
    StringArray names;
    if (const StringArray* list = node->value.as<StringArray>()) names = *list;
    if (const std::string* name = node->value.as<std::string>()) names = {*name};
    for (const std::string& name : names) {
      auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& known) { return known.first == name; });
      if (group == groups.end()) group = groups.insert(group, {name, {}});
      group->second.push_back(frame->name);
    }
  }
  return groups;
}

}  // namespace kinegraph::inline scene_internal
