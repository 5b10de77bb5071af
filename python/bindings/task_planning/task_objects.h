#pragma once

#include "bindings.h"
#include "kinegraph/task_planning/search/task_plan.h"

namespace kinegraph::python {

/// A Config as Python knows it, on the very same scene.
PyConfig sameScene(const Config& C);

/// A kinegraph.TaskPlan as C++ knows it, without what it would be planned again by.
TaskPlan taskPlanOf(nb::handle given);

void bindTaskPlays(nb::module_& m);  ///< plans of tasks shown and carried out
void bindLgp(nb::module_& m);        ///< LGP_Tool, and what it asks of a domain

}  // namespace kinegraph::python
