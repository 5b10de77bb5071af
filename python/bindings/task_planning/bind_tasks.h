#pragma once

#include <nanobind/nanobind.h>

namespace kinegraph::python {

void bindManipulation(nanobind::module_& m);
void bindLogic(nanobind::module_& m);
void bindTasks(nanobind::module_& m);  ///< after what plans and motions are made of

}  // namespace kinegraph::python
