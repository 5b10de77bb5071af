#pragma once

#include "bindings.h"
#include "kinegraph/tasks/search/task_plan.h"

namespace kinegraph::python {

/// A kinegraph.TaskPlan as C++ knows it, without what it would be planned again by.
TaskPlan taskPlanOf(nb::handle given);

void bindTaskPlays(nb::module_& m);  ///< plans of tasks shown and carried out

}  // namespace kinegraph::python
