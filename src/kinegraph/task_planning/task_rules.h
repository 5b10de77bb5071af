#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph {

class TaskWaypoints;

/// The geometric meaning of an action of planTask: the constraints of its waypoints, and its variants. For example:
///
///     TaskRule show{[](TaskWaypoints& w, double time, const TaskAction& action, const std::string& variant) {
///                     const double height = variant == "high" ? 1.2 : .9;
///                     w.komo().addObjective({time}, FS::position, {action[1]}, OT::eq, row(0., 0., 10.), height);
///                   },
///                   [](const Config&, const TaskAction&) { return std::vector<std::string>{"high", "low"}; }};
///
/// Several threads may call both functions at the same time.
struct TaskRule {
  /// Adds the constraints of the action at a time (in phases), in one of its variants.
  std::function<void(TaskWaypoints& w, double time, const TaskAction& action, const std::string& variant)> add;

  /// Returns the names of its variants in a scene, the best first; none: the action is impossible.
  std::function<std::vector<std::string>(const Config& C, const TaskAction& action)> variants;
};

/// Rules by the names of the actions.
using TaskRules = std::map<std::string, TaskRule>;

/// Returns the rules of the actions of defaultDomain. `upright`: `place` puts objects down upright, and leaves other
/// faces to `lay`, for goals that name a face.
TaskRules defaultTaskRules(bool upright = false);

/// Returns the palm, the frame between the fingers of a hand and its arm that held objects must not enter; "" for hands
/// without one.
std::string palmOf(const Config& C, const std::string& hand);

/// Returns the opening of the fingers of a hand, m; none for a hand without fingers. The attribute `opening` of its
/// frame overrides the default, .08 m for a hand with a palm.
std::optional<double> opening(const Config& C, const std::string& hand);

/// Returns the scene with the attribute `opening` at each hand that has none and whose fingers are modeled
/// (handFingersOf).
Config withOpenings(const Config& C, const std::vector<std::string>& hands);

/// Returns the grasps of an object by a hand. Boxes and meshes have the axes x, y, z along which the fingers can close,
/// the narrow ones first; cylinders and capsules `around`, balls `center`, and hands without fingers `touch`. None if
/// the object is too wide. Throws ValueError for objects without a shape.
std::vector<std::string> graspVariants(const Config& C, const std::string& obj, const std::string& hand);

/// Whether the fingers of a hand fit an object, as it stands, along its upright axis only: from its side, with one of
/// them below it.
bool isTooWideAcross(const Config& C, const std::string& obj, const std::string& hand);

/// Returns at most `most` combinations of the variants of a sequence of actions, the best first. Throws NameError for
/// an action without a rule.
std::vector<std::vector<std::string>> allVariants(const Config& C, const std::vector<TaskAction>& actions,
                                                  const TaskRules& rules, std::size_t most);

}  // namespace kinegraph
