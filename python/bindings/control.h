#pragma once

#include <nanobind/nanobind.h>

namespace kinegraph::python {

void bindDiffIk(nanobind::module_& m);
void bindMpc(nanobind::module_& m);

}  // namespace kinegraph::python
