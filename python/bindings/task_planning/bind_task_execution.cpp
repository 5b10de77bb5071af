#include <nanobind/stl/string.h>

#include "arrays.h"
#include "kinegraph/api/task_execution.h"
#include "kinegraph/common/text.h"
#include "python_names.h"
#include "task_planning/task_objects.h"
#include "task_planning/task_plan_docs.h"

namespace kinegraph::python {

void bindTaskExecution(nb::module_& m) {
  nb::class_<TaskExecution>(m, "TaskExecution", docs::task_plan::execution)
      .def_ro("feasible", &TaskExecution::feasible, "True if all actions were executed and the goal holds.")
      .def_prop_ro(
          "message", [](const TaskExecution& run) { return inPython(run.message); },
          "\"\" if feasible; else the reason for which the robot stopped.")
      .def_ro("done", &TaskExecution::done, "The number of executed actions.")
      .def_prop_ro(
          "C",
          [](const TaskExecution& run) {
            return PyConfig{Config(run.C.scene()), nullptr};
          },
          "The final scene: held objects are attached to the hand, and objects that stand on something to that.")
      .def("__bool__", [](const TaskExecution& run) { return run.feasible; })
      .def("__str__", [](const TaskExecution& run) { return inPython(run.str()); })
      .def("__repr__", [](const TaskExecution& run) { return cat("<TaskExecution ", inPython(run.str()), ">"); });
}

}  // namespace kinegraph::python
