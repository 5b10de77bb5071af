#pragma once

#include <nanobind/nanobind.h>

namespace kinegraph::python {

void bindDiffIk(nanobind::module_& m);
void bindMpc(nanobind::module_& m);
void bindStreams(nanobind::module_& m);  ///< after DiffIk

}  // namespace kinegraph::python
