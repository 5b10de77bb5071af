#pragma once

#include "bindings.h"

namespace kinegraph::python {

void bindSimulation(nb::module_& m);

}  // namespace kinegraph::python
