#include "kinegraph/task_planning/search/plan_task.h"

#include <algorithm>

#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/search/task_search.h"

namespace kinegraph {

TaskPlan planTask(const Config& C, const std::string& goal, const TaskOptions& options) {
  return TaskPlans(C, goal, options).next().value();
}

std::function<TaskPlan(const Config&, const RepairOptions&)> replannerTo(std::string goal, TaskOptions options) {
  return [goal = std::move(goal), options = std::move(options)](const Config& C, const RepairOptions& limits) {
    TaskOptions changed = options;
    if (limits.time_limit) changed.time_limit = *limits.time_limit;
    if (limits.max_evaluations) changed.max_evaluations = *limits.max_evaluations;
    if (limits.threads) changed.threads = *limits.threads;
    const auto knows = [&](const char* word) {
      return !options.domain || std::ranges::count(options.domain->symbols, word) > 0;
    };
    std::string whole = goal;
    std::vector<std::string> left_out;
    for (const Literal& literal : readLiterals(limits.also, "also")) {
      if (literal.predicate != "up" || (knows("up") && knows("z")))
        whole += " " + literal.str();
      else
        left_out.push_back(literal.str());
    }
    TaskPlan plan = planTask(C, whole, changed);
    for (const std::string& literal : left_out)
      plan.warnings.push_back(cat("the goal is without ", literal, ", because the domain has no `up`"));
    return plan;
  };
}

TaskPlans planTasks(const Config& C, const std::string& goal, const TaskOptions& options) {
  return TaskPlans(C, goal, options);
}

TaskPlans::TaskPlans(const Config& C, const std::string& goal, const TaskOptions& options)
    : search_(std::make_unique<TaskSearch>(C, goal, options)) {}
TaskPlans::TaskPlans(TaskPlans&&) noexcept = default;
TaskPlans& TaskPlans::operator=(TaskPlans&&) noexcept = default;
TaskPlans::~TaskPlans() = default;

std::optional<TaskPlan> TaskPlans::next() { return search_->next(); }

}  // namespace kinegraph
