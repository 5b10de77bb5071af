#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arrays.h"
#include "kinegraph/api/task_execution.h"
#include "kinegraph/api/task_view.h"
#include "python_names.h"
#include "robot/robot_objects.h"
#include "task_planning/task_objects.h"
#include "task_planning/task_plays_docs.h"

namespace kinegraph::python {

namespace {

TaskExecution executeTask(nb::handle given, PyBotOp& bot) {
  const TaskPlan plan = taskPlanOf(given);
  PyConfig seen{bot->getWorld(), nullptr};
  const nb::gil_scoped_release unlock;
  return execute(plan, *bot, seen);
}

Array framesOf(nb::handle given, const PyConfig& C, double rate) {
  const std::vector<MatrixXd> poses = taskPlanOf(given).frames(C, rate);
  const NewArray all = newArray(poses.size(), std::size_t(poses[0].rows()), 7);
  double* next = all.data;
  for (const MatrixXd& rows : poses)
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      for (Eigen::Index k = 0; k < 7; ++k) *next++ = rows(i, k);
  return all.array;
}

}  // namespace

void bindTaskPlays(nb::module_& m) {
  nb::class_<TaskExecution>(m, "TaskExecution", docs::task_plays::execution)
      .def_ro("feasible", &TaskExecution::feasible,
              "All actions were carried out, and what the goal says stands where it says.")
      .def_prop_ro(
          "message", [](const TaskExecution& run) { return inPython(run.message); }, "Why it stopped.")
      .def_ro("done", &TaskExecution::done, "The number of actions that were carried out.")
      .def_prop_ro(
          "C",
          [](const TaskExecution& run) {
            return PyConfig{Config(run.C.scene()), nullptr};
          },
          "The scene as it is then: what is held hangs below the hand, what stands on something below that.")
      .def("__str__", [](const TaskExecution& run) { return inPython(run.str()); })
      .def("__repr__", [](const TaskExecution& run) { return inPython(run.str()); });
  m.def("executeTask", executeTask, "plan"_a, "bot"_a,
        nb::sig("def executeTask(plan: TaskPlan, bot: BotOp) -> TaskExecution"), docs::task_plays::executeTask);
  m.def("taskFrames", framesOf, "plan"_a, "C"_a, "rate"_a = 25.,
        nb::sig("def taskFrames(plan: TaskPlan, C: Config, rate: float = 25.0) -> numpy.ndarray"),
        docs::task_plays::frames);
  m.def(
      "failedConfiguration",
      [](nb::handle plan, const PyConfig& C) {
        return PyConfig{taskPlanOf(plan).failedConfiguration(C), nullptr};
      },
      "plan"_a, "C"_a, nb::sig("def failedConfiguration(plan: TaskPlan, C: Config) -> Config"),
      docs::task_plays::failedConfiguration);
  m.def(
      "showTask", [](PyConfig& C, PyConfig& scene, const Numbers& q) { showTask(C, scene, q.values); }, "C"_a,
      "scene"_a, "q"_a, docs::task_plays::show);
}

}  // namespace kinegraph::python
