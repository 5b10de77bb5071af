#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "arrays.h"
#include "kinegraph/api/execution/task_execution.h"
#include "kinegraph/common/text.h"
#include "perception/scene_observer_object.h"
#include "python_names.h"
#include "robot/robot_objects.h"
#include "task_planning/task_execution_docs.h"
#include "task_planning/task_objects.h"

namespace kinegraph::python {

namespace {

/// An execution, and the scene that it keeps up to date.
struct PyTaskRun {
  std::unique_ptr<PyConfig> seen;
  std::shared_ptr<const TaskRequest> request;
  TaskRun run;
};

std::function<ObservedPoses(Config&)> observer(const nb::object& observe) {
  if (observe.is_none()) return {};
  if (nb::isinstance<PySceneObserver>(observe))
    return [observe](Config& scene) { return nb::cast<PySceneObserver&>(observe).observe(scene); };
  return [observe](Config&) {
    const nb::gil_scoped_acquire lock;
    ObservedPoses poses;
    for (const auto& [name, pose] : nb::cast<std::map<std::string, nb::object>>(observe()))
      poses[name] = pose.is_none() ? std::nullopt : std::optional(Pose::fromNumbers(nb::cast<Numbers>(pose).values));
    return poses;
  };
}

BotOp& robotOf(nb::handle robot, const char* call) {
  if (nb::isinstance<PyBotOp>(robot)) return *nb::cast<PyBotOp&>(robot);
  const char* hint = nb::isinstance<PyConfig>(robot) ? "; make one by BotOp(C)" : "";
  throw ValueError(
      cat("TaskPlan.", call, ": expected a BotOp, got ", nb::cast<std::string>(robot.type().attr("__name__")), hint));
}

PyTaskRun makeRun(const PyTaskPlan& plan, BotOp& bot, ExecutionOptions options) {
  auto seen = std::make_unique<PyConfig>(PyConfig{worldOf(bot, plan, bool(options.observe)), nullptr});
  TaskRun run(plan, bot, *seen, std::move(options));
  return {std::move(seen), plan.request, std::move(run)};
}

ExecutionOptions executionOptions(int repairs, const nb::object& observe, const std::optional<Numbers>& limits,
                                  std::optional<double> time_limit, std::optional<long> max_evaluations,
                                  std::optional<int> threads) {
  ExecutionOptions options;
  options.repairs = repairs;
  options.observe = observer(observe);
  if (limits) options.max_external_effort = limits->values;
  options.repair = {time_limit, max_evaluations, threads};
  return options;
}

PyTaskRun runPlan(const PyTaskPlan& plan, nb::handle robot, int repairs, const nb::object& observe,
                  const std::optional<Numbers>& limits, std::optional<double> time_limit,
                  std::optional<long> max_evaluations, std::optional<int> threads) {
  return makeRun(plan, robotOf(robot, "run"),
                 executionOptions(repairs, observe, limits, time_limit, max_evaluations, threads));
}

TaskExecution executePlan(const PyTaskPlan& plan, nb::handle robot, int repairs, const nb::object& observe,
                          const nb::object& callback, const std::optional<Numbers>& limits,
                          std::optional<double> time_limit, std::optional<long> max_evaluations,
                          std::optional<int> threads) {
  PyTaskRun run = makeRun(plan, robotOf(robot, "execute"),
                          executionOptions(repairs, observe, limits, time_limit, max_evaluations, threads));
  const nb::gil_scoped_release unlock;
  while (const std::optional<TaskEvent> event = run.run.next()) {
    if (callback.is_none()) continue;
    const nb::gil_scoped_acquire lock;
    const nb::object answer = callback(*event);
    if (answer.ptr() == Py_False) run.run.stop();
  }
  return run.run.result();
}

void bindEvents(nb::module_& m) {
  nb::enum_<TaskEventKind> kinds(m, "TaskEventKind", docs::task_execution::kind);
  for (int i = 0; i <= int(TaskEventKind::end); ++i) {
    static std::vector<std::string> names(std::size_t(TaskEventKind::end) + 1);
    names[std::size_t(i)] = taskEventName(TaskEventKind(i));
    kinds.value(names[std::size_t(i)].c_str(), TaskEventKind(i));
  }
  nb::class_<TaskEvent>(m, "TaskEvent", "A step of an execution that is done. The robot rests.")
      .def_ro("kind", &TaskEvent::kind, "Kind of the event, a TaskEventKind.")
      .def_ro("index", &TaskEvent::index, "Index of the action in the present plan; -1 for start, repair and end.")
      .def_ro("action", &TaskEvent::action, "The words of the action; [] without one.")
      .def_prop_ro(
          "message", [](const TaskEvent& event) { return inPython(event.message); },
          "The reason of a failure, the actions of a repair, the result at the end; else \"\".")
      .def("__str__", [](const TaskEvent& event) { return inPython(event.str()); })
      .def("__repr__", [](const TaskEvent& event) { return cat("<TaskEvent ", inPython(event.str()), ">"); });
}

}  // namespace

void bindTaskExecution(nb::module_& m) {
  nb::class_<TaskExecution>(m, "TaskExecution", docs::task_execution::result)
      .def_ro("feasible", &TaskExecution::feasible, "True if all actions were executed and the goal holds.")
      .def_prop_ro(
          "message", [](const TaskExecution& run) { return inPython(run.message); },
          "\"\" if feasible; else the reason for which the robot stopped.")
      .def_ro("done", &TaskExecution::done, "The number of executed actions, of all plans.")
      .def_ro("repairs", &TaskExecution::repairs, "The number of plans that were made on the way.")
      .def_prop_ro(
          "C", [](const TaskExecution& run) { return sameScene(run.C); },
          "The final scene: held objects are attached to the hand, and objects that stand on something to that.")
      .def("__bool__", [](const TaskExecution& run) { return run.feasible; })
      .def("__str__", [](const TaskExecution& run) { return inPython(run.str()); })
      .def("__repr__", [](const TaskExecution& run) { return cat("<TaskExecution ", inPython(run.str()), ">"); });
  bindEvents(m);
  nb::class_<PyTaskRun>(m, "TaskRun", docs::task_execution::run_type)
      .def(
          "__iter__", [](nb::handle run) { return nb::borrow(run); }, nb::sig("def __iter__(self) -> TaskRun"),
          "Itself.")
      .def(
          "__next__",
          [](PyTaskRun& self) {
            std::optional<TaskEvent> event;
            {
              const nb::gil_scoped_release unlock;
              event = self.run.next();
            }
            if (!event) throw nb::stop_iteration();
            return std::move(*event);
          },
          "Executes the next step, and returns it.")
      .def(
          "stop", [](PyTaskRun& self) { self.run.stop(); },
          "Ends the execution: the robot holds, also during a motion. May be called from any thread.")
      .def_prop_ro(
          "result", [](const PyTaskRun& self) { return self.run.result(); },
          "The TaskExecution; complete after the event `end`.")
      .def_prop_ro(
          "plan", [](const PyTaskRun& self) { return PyTaskPlan(self.run.plan(), self.request); }, "The present plan.");
}

void bindExecutionOf(nb::class_<PyTaskPlan, Trajectory>& plan) {
  namespace docs = docs::task_execution;
  plan.def("execute", executePlan, "bot"_a, nb::kw_only(), "repairs"_a = 3, "observe"_a = nb::none(),
           "callback"_a = nb::none(), "max_external_effort"_a = nb::none(), "time_limit"_a = nb::none(),
           "max_evaluations"_a = nb::none(), "threads"_a = nb::none(),
           nb::sig("def execute(self, bot: BotOp, *, repairs: int = 3, observe: SceneObserver | "
                   "collections.abc.Callable[[], collections.abc.Mapping[str, numpy.typing.ArrayLike | None]] | None = "
                   "None, callback: "
                   "collections.abc.Callable[[TaskEvent], object] | None = None, max_external_effort: "
                   "numpy.typing.ArrayLike | None = None, time_limit: float | None = None, max_evaluations: int | None "
                   "= None, threads: int | None = None) -> TaskExecution"),
           docs::execute)
      .def("run", runPlan, "bot"_a, nb::kw_only(), "repairs"_a = 3, "observe"_a = nb::none(),
           "max_external_effort"_a = nb::none(), "time_limit"_a = nb::none(), "max_evaluations"_a = nb::none(),
           "threads"_a = nb::none(), nb::keep_alive<0, 2>(),
           nb::sig("def run(self, bot: BotOp, *, repairs: int = 3, observe: SceneObserver | "
                   "collections.abc.Callable[[], collections.abc.Mapping[str, numpy.typing.ArrayLike | None]] | None = "
                   "None, max_external_effort: "
                   "numpy.typing.ArrayLike | None = None, time_limit: float | None = None, max_evaluations: int | None "
                   "= None, threads: int | None = None) -> TaskRun"),
           docs::run);
}

}  // namespace kinegraph::python
