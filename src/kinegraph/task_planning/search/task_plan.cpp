#include "kinegraph/task_planning/search/task_plan.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

constexpr std::size_t kShownCauses = 8;  ///< in `str`

}  // namespace

std::string taskStatusName(TaskStatus status) {
  switch (status) {
    case TaskStatus::solved:
      return "solved";
    case TaskStatus::infeasible:
      return "infeasible";
    case TaskStatus::timeout:
      return "timeout";
    default:
      return "no_plan_found";
  }
}

void TaskPlan::requireMotion(const char* call) const {
  if (path.rows() == 0 || times.size() != path.rows())
    throw ValueError(cat("TaskPlan.", call, ": the plan has no motion", message.empty() ? "" : "; ", message));
}

void TaskPlan::requireScenes(const char* call) const {
  requireMotion(call);
  if (scenes.size() != actions.size() || segments.size() != actions.size())
    throw ValueError(cat("TaskPlan.", call, ": the plan has ", actions.size(), " actions, ", scenes.size(),
                         " scenes and ", segments.size(), " segments; expected one scene and one segment per action"));
}

void TaskPlan::evalTo(double t, double* q, double* velocity, double* acceleration) const {
  requireMotion("eval");
  const Eigen::Index n = path.cols();
  Eigen::Map<Eigen::RowVectorXd> position(q, n), slope(velocity, n);
  slope.setZero();
  std::fill_n(acceleration, n, 0.);
  const double* const begin = times.data();
  const Eigen::Index after = std::upper_bound(begin, begin + times.size(), t) - begin;
  if (after == 0) {
    position = path.row(0);
  } else if (after == times.size()) {
    position = path.row(after - 1);
  } else {
    const double seconds = times[after] - times[after - 1], share = (t - times[after - 1]) / seconds;
    position = path.row(after - 1) + share * (path.row(after) - path.row(after - 1));
    if (t > times[0]) slope = (path.row(after) - path.row(after - 1)) / seconds;
  }
}

std::string TaskPlan::summary() const {
  if (!feasible()) return message;
  if (actions.empty()) return "the goal already holds";
  return cat(actions.size(), actions.size() == 1 ? " action, " : " actions, ", fixed(duration(), 2), " s");
}

std::string TaskPlan::explain() const {
  std::string text = cat(taskStatusName(status), ": ", summary());
  const auto weakest = std::ranges::min_element(tolerances, {}, &StepTolerance::error);
  if (weakest != tolerances.end()) {
    const auto step = std::size_t(weakest - tolerances.begin());
    text += cat("\nweakest step: ", step + 1, ". ", planText({actions[step]}), " survives errors of poses of ",
                fixed(1e3 * weakest->error, 1), " mm", weakest->limit.empty() ? " or more" : "; then ", weakest->limit);
  }
  for (const std::string& warning : warnings) text += "\nwarning: " + warning;
  text += cat("\n", evaluations, " evaluations of motion problems, ", expansions, " expansions of states in logic");
  for (const auto& [cause, count] : causes)
    text += cat("\n", cause, " (", count, count == 1 ? " branch)" : " branches)");
  return text;
}

std::string TaskPlan::searchTree() const { return treeText(tree); }

TaskPlan TaskPlan::repair(const Config& C, const RepairOptions& options) const {
  if (!replanner) throw ValueError("TaskPlan.repair: the plan was not made by planTask, and has no goal and options");
  return replanner(C, options);
}

std::string TaskPlan::str() const {
  std::string text = cat(taskStatusName(status), ": ", summary());
  for (std::size_t i = 0; i < actions.size(); ++i) text += cat("\n  ", i + 1, ". ", planText({actions[i]}));
  for (std::size_t i = 0; i < std::min(kShownCauses, causes.size()); ++i)
    text += cat("\n  ", causes[i].second, " x ", causes[i].first);
  return text;
}

std::string treeText(const std::vector<TaskBranch>& branches) {
  std::vector<std::string> lines;
  std::vector<TaskAction> previous;
  for (const TaskBranch& branch : branches) {
    const std::size_t count = branch.actions.size();
    std::size_t common = 0;
    while (common < std::min(count, previous.size()) && branch.actions[common] == previous[common]) ++common;
    if (common == count && common > 0) --common;
    for (std::size_t depth = common; depth < count; ++depth)
      lines.push_back(std::string(2 * depth, ' ') + planText({branch.actions[depth]}));
    if (!lines.empty()) lines.back() += branch.cause.empty() ? ": plan" : ": " + branch.cause;
    previous = branch.actions;
  }
  return join(lines, "\n");
}

}  // namespace kinegraph
