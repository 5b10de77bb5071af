#pragma once

#include "bindings.h"

namespace kinegraph::python {

void bindRobotDriver(nb::module_& m);

}  // namespace kinegraph::python
