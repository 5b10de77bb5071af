#include "kinegraph/task_planning/search/crowded_hands.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/task_planning/grasps.h"
#include "kinegraph/task_planning/task_actions.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph::inline task_planning_internal {

namespace {

/// Whether a sentence has a name as a whole word.
bool mentions(const std::string& sentence, const std::string& name) {
  constexpr std::string_view kBetween = " '\"(),;";
  const auto isBetween = [&](std::size_t at) {
    return at >= sentence.size() || kBetween.find(sentence[at]) != std::string_view::npos;
  };
  for (std::size_t at = sentence.find(name); at != std::string::npos; at = sentence.find(name, at + 1))
    if ((at == 0 || isBetween(at - 1)) && isBetween(at + name.size())) return true;
  return false;
}

}  // namespace

bool isInTheWay(const Config& C, const TaskPlan& failed) {
  for (const std::string& hand : wordsOf(failed.start, "is_gripper")) {
    std::vector<std::string> parts = fingerShapes(C, hand);
    if (const std::string palm = palmOf(C, hand); !palm.empty()) parts.push_back(palm);
    for (const auto& [cause, count] : failed.causes)
      for (const std::string& part : parts)
        if (mentions(cause, part)) return true;
  }
  return false;
}

bool isCrowded(const Config& C, const TaskPlan& plan) {
  std::vector<std::string> fingers;
  for (const std::string& hand : wordsOf(plan.start, "is_gripper"))
    for (const std::string& part : fingerShapes(C, hand)) fingers.push_back(part);
  return std::ranges::any_of(plan.warnings, [&](const std::string& warning) {
    const auto isNear = [&](const std::string& name) { return mentions(warning.substr(warning.find(':')), name); };
    return std::ranges::any_of(plan.actions, [&](const TaskAction& action) {
      return warning.starts_with(planText({action}) + ":") && std::ranges::any_of(fingers, isNear) &&
             std::none_of(action.begin() + 1, action.end(), isNear);
    });
  });
}

}  // namespace kinegraph::inline task_planning_internal
