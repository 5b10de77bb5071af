#pragma once

#include <nanobind/nanobind.h>

namespace kinegraph::python {

void bindManipulation(nanobind::module_& m);
void bindLogic(nanobind::module_& m);

}  // namespace kinegraph::python
