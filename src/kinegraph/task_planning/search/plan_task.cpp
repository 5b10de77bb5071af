#include "kinegraph/task_planning/search/plan_task.h"

#include "kinegraph/task_planning/search/task_search.h"

namespace kinegraph {

TaskPlan planTask(const Config& C, const std::string& goal, const TaskOptions& options) {
  return TaskPlans(C, goal, options).next().value();
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
