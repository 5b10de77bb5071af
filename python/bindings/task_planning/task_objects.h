#pragma once

#include <map>
#include <optional>

#include "bindings.h"
#include "kinegraph/task_planning/search/plan_task.h"

namespace kinegraph::python {

/// A Config for Python that shares the scene of C.
PyConfig sameScene(const Config& C);

/// A TaskRule of two Python functions.
struct PyTaskRule {
  nb::callable add, variants;
};

/// Rules by the names of their actions; none: the default rules only.
using PyTaskRules = std::optional<std::map<std::string, PyTaskRule>>;

/// Rules that call the Python functions with the interpreter lock.
TaskRules taskRules(const PyTaskRules& rules);

/// The arguments of a call to planTask. A plan keeps them so that a pickled copy can be repaired.
struct TaskRequest {
  std::string goal;
  std::optional<LogicDomain> domain = {};
  PyTaskRules rules = {};
  std::optional<double> time_limit = {};
  long max_evaluations = 200000;
  std::uint64_t seed = 0;
  VectorXd velocity = {}, acceleration = {};
  int threads = 1;
  double margin = kTaskMargin;
  double contact_speed = kContactSpeed;

  TaskOptions options() const;
};

/// A plan and the request that led to it; null for a plan that was not made by planTask.
struct PyTaskPlan : TaskPlan {
  PyTaskPlan() = default;
  PyTaskPlan(TaskPlan plan, std::shared_ptr<const TaskRequest> request)
      : TaskPlan(std::move(plan)), request(std::move(request)) {}

  std::shared_ptr<const TaskRequest> request;
};

/// The literals as texts: "(on table cup)".
std::vector<std::string> literalTexts(const std::vector<Literal>& literals);

/// (error, limit) of each step.
std::vector<std::pair<double, std::string>> toleranceList(const std::vector<StepTolerance>& tolerances);

void bindTaskPlan(nb::module_& m);  ///< TaskStatus, TaskBranch, TaskPlan
void bindTaskPlanCopies(nb::class_<TaskBranch>& branch,
                        nb::class_<PyTaskPlan, Trajectory>& plan);  ///< copy.copy and pickle
void bindTaskExecution(nb::module_& m);                             ///< TaskExecution, TaskEvent, TaskRun
void bindExecutionOf(nb::class_<PyTaskPlan, Trajectory>& plan);     ///< TaskPlan.execute, TaskPlan.run
void bindPlanTask(nb::module_& m);                                  ///< planTask, planTasks
void bindLgp(nb::module_& m);                                       ///< LGP_Tool and its abstractions

}  // namespace kinegraph::python
