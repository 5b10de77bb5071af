#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "kinegraph/common/text.h"
#include "kinegraph/logic/domain.h"
#include "kinegraph/task_planning/search/plan_task.h"
#include "task_planning/py_manipulation.h"
#include "task_planning/task_objects.h"
#include "task_planning/tasks_docs.h"

namespace kinegraph::python {

namespace {

/// An anytime search, and its request and scene.
struct PyTaskPlans {
  std::shared_ptr<const TaskRequest> request;
  PyConfig scene;
  TaskPlans plans;
};

/// The arguments of planTask and planTasks.
PyTaskPlans plansOf(const PyConfig& C, const std::string& goal, const std::optional<LogicDomain>& domain,
                    const PyTaskRules& rules, std::optional<double> time_limit, long max_evaluations,
                    std::uint64_t seed, const std::optional<Numbers>& velocity,
                    const std::optional<Numbers>& acceleration, int threads, double margin, double contact_speed) {
  const auto request = std::make_shared<const TaskRequest>(
      TaskRequest{goal, domain, rules, time_limit, max_evaluations, seed, velocity ? velocity->values : VectorXd(),
                  acceleration ? acceleration->values : VectorXd(), threads, margin, contact_speed});
  const TaskOptions options = request->options();
  warnOfMissingContacts(C);
  PyConfig scene{Config(C), nullptr};
  const nb::gil_scoped_release unlock;
  TaskPlans plans(scene, goal, options);
  return {request, std::move(scene), std::move(plans)};
}

std::optional<PyTaskPlan> nextOf(PyTaskPlans& self) {
  std::optional<TaskPlan> plan;
  {
    const nb::gil_scoped_release unlock;
    plan = self.plans.next();
  }
  if (!plan) return std::nullopt;
  return PyTaskPlan{std::move(*plan), self.request};
}

std::vector<std::string> check(const PyConfig& C, const PyTaskPlan& plan,
                               const std::optional<std::vector<std::vector<std::string>>>& states,
                               std::optional<double> margin) {
  std::vector<std::vector<Literal>> along;
  if (states)
    for (const auto& state : *states) along.push_back(readLiterals(join(state, " "), "states"));
  warnOfContacts(C);
  const Config scene(C);
  const nb::gil_scoped_release unlock;
  return checkTaskPlan(scene, plan, along, margin);
}

}  // namespace

TaskOptions TaskRequest::options() const {
  TaskOptions options;
  options.domain = domain;
  options.rules = taskRules(rules);
  if (time_limit) options.time_limit = *time_limit;
  options.max_evaluations = max_evaluations;
  options.seed = seed;
  options.velocity = velocity;
  options.acceleration = acceleration;
  options.threads = threads;
  options.margin = margin;
  options.contact_speed = contact_speed;
  options.cancellation = [check = CheckInterrupts()]() mutable { check(); };
  options.helper = [] { return std::make_shared<PyManipulation>(); };
  return options;
}

void bindPlanTask(nb::module_& m) {
  nb::class_<PyTaskPlans>(m, "TaskPlans", "An iterator of ever faster plans; planTasks makes it.")
      .def(
          "__iter__", [](nb::handle plans) { return nb::borrow(plans); }, nb::sig("def __iter__(self) -> TaskPlans"),
          "Itself.")
      .def(
          "__next__",
          [](PyTaskPlans& plans) {
            std::optional<PyTaskPlan> plan = nextOf(plans);
            if (!plan) throw nb::stop_iteration();
            return std::move(*plan);
          },
          "The next plan.");
  const auto bind = [&](const char* name, auto call, const char* returned, const char* doc) {
    const std::string signature =
        cat("def ", name,
            "(C: Config, goal: str, *, domain: Domain | None = None, rules: collections.abc.Mapping[str, TaskRule] | "
            "None = None, time_limit: float | None = None, max_evaluations: int = 200000, seed: int = 0, velocity: "
            "numpy.typing.ArrayLike | None = None, acceleration: numpy.typing.ArrayLike | None = None, threads: int = "
            "1, margin: float = 0.005, contact_speed: float = 0.15) -> ",
            returned);
    m.def(name, call, "C"_a, "goal"_a, nb::kw_only(), "domain"_a = nb::none(), "rules"_a = nb::none(),
          "time_limit"_a = nb::none(), "max_evaluations"_a = 200000, "seed"_a = 0, "velocity"_a = nb::none(),
          "acceleration"_a = nb::none(), "threads"_a = 1, "margin"_a = kTaskMargin, "contact_speed"_a = kContactSpeed,
          nb::sig(signature.c_str()), doc);
  };
  const auto first = []<class... Arguments>(PyTaskPlans (*plans)(Arguments...)) {
    return [plans](Arguments... arguments) {
      PyTaskPlans all = plans(arguments...);
      return nextOf(all).value();
    };
  };
  bind("planTask", first(plansOf), "TaskPlan", docs::tasks::planTask);
  bind("planTasks", plansOf, "TaskPlans", docs::tasks::planTasks);
  m.def("checkTaskPlan", check, "C"_a, "plan"_a, "states"_a = nb::none(), "margin"_a = nb::none(),
        docs::tasks::checkTaskPlan);
}

}  // namespace kinegraph::python
