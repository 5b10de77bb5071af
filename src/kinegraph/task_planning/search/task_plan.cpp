#include "kinegraph/task_planning/search/task_plan.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

constexpr std::size_t kCauses = 8;  ///< that are told by `str`

}  // namespace

std::string taskStatusName(TaskStatus status) {
  switch (status) {
    case TaskStatus::solved:
      return "solved";
    case TaskStatus::infeasible:
      return "proved impossible";
    default:
      return "not found";
  }
}

void TaskPlan::requireMotion(const char* call) const {
  if (path.rows() == 0 || times.size() != path.rows()) throw ValueError(cat(call, ": there is no motion; ", message));
}

VectorXd TaskPlan::at(double t) const {
  requireMotion("at");
  const double* const begin = times.data();
  const Eigen::Index after = std::upper_bound(begin, begin + times.size(), t) - begin;
  if (after == 0) return path.row(0);
  if (after == times.size()) return path.row(after - 1);
  const double share = (t - times[after - 1]) / (times[after] - times[after - 1]);
  return path.row(after - 1) + share * (path.row(after) - path.row(after - 1));
}

std::string TaskPlan::why() const {
  if (causes.empty()) return message;
  std::vector<std::string> lines;
  for (const auto& [cause, count] : causes) lines.push_back(cat(cause, " (", count, " branches)"));
  return join(lines, "\n");
}

std::string TaskPlan::searchTree() const { return treeText(tree); }

TaskPlan TaskPlan::repair(const Config& C) const {
  if (!again) throw ValueError("repair: this plan was not made by planTask, and has no goal to go on to");
  return again(C);
}

std::string TaskPlan::str() const {
  std::string text = cat(taskStatusName(status), ": ", message);
  for (std::size_t i = 0; i < actions.size(); ++i) text += cat("\n  ", i + 1, ". ", planText({actions[i]}));
  for (std::size_t i = 0; i < std::min(kCauses, causes.size()); ++i)
    text += cat("\n  ", causes[i].second, " x ", causes[i].first);
  return text;
}

std::string treeText(const std::vector<TaskBranch>& branches) {
  std::vector<std::string> lines;
  std::vector<TaskAction> shown;
  for (const TaskBranch& branch : branches) {
    const std::size_t count = branch.actions.size();
    std::size_t common = 0;
    while (common < std::min(count, shown.size()) && branch.actions[common] == shown[common]) ++common;
    if (common == count && common > 0) --common;
    for (std::size_t depth = common; depth < count; ++depth)
      lines.push_back(std::string(2 * depth, ' ') + planText({branch.actions[depth]}));
    if (!lines.empty()) lines.back() += branch.why.empty() ? ": found" : ": " + branch.why;
    shown = branch.actions;
  }
  return join(lines, "\n");
}

}  // namespace kinegraph
