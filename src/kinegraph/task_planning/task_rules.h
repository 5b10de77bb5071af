#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph {

class TaskWaypoints;

/// An action of planTask: what it asks of the waypoints, and in which ways it can be done. An own one:
///
///     TaskRule show{[](TaskWaypoints& w, double time, const TaskAction& action, const std::string& variant) {
///                     const double height = variant == "high" ? 1.2 : .9;
///                     w.komo().addObjective({time}, FS::position, {action[1]}, OT::eq, row(0., 0., 10.), height);
///                   },
///                   [](const Config&, const TaskAction&) { return std::vector<std::string>{"high", "low"}; }};
///
/// Both may be called by several threads at the same time.
struct TaskRule {
  /// Adds what the action asks at a time (in phases), in one of its variants.
  std::function<void(TaskWaypoints& w, double time, const TaskAction& action, const std::string& variant)> add;

  /// The names of its variants in a scene, best first; none: it cannot be done.
  std::function<std::vector<std::string>(const Config& C, const TaskAction& action)> variants;
};

/// By the first words of the actions.
using TaskRules = std::map<std::string, TaskRule>;

/// Of the actions of defaultDomain. `upright` where the goal says which face of something is up: `place` then leaves other
/// faces to `lay`.
TaskRules defaultTaskRules(bool upright = false);

/// The frame between the fingers of a hand and its arm, which nothing that is held comes into; "" for hands without one.
std::string palmOf(const Config& C, const std::string& hand);

/// How far the fingers of a hand open, m; none for a hand without fingers. Its frame may say it as `opening`.
std::optional<double> opening(const Config& C, const std::string& hand);

/// The ways in which a hand can hold an object: axes of the object that the fingers close along, narrow ones first: of x,
/// y, z for boxes and meshes, `around` for cylinders and capsules, `center` for balls, `touch` for hands without fingers.
/// None if it is too wide. Throws ValueError for objects without a shape.
std::vector<std::string> graspVariants(const Config& C, const std::string& obj, const std::string& hand);

/// Combinations of the variants of a sequence of actions, the first ones first, `most` of them. Throws NameError for an
/// action that has no rule.
std::vector<std::vector<std::string>> allVariants(const Config& C, const std::vector<TaskAction>& actions,
                                                  const TaskRules& rules, std::size_t most);

}  // namespace kinegraph
