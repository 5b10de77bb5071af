#pragma once

#include "bindings.h"
#include "kinegraph/solvers/explanation.h"

namespace kinegraph::python {

/// A dict per conflict; lengths or angles that it does not have are None.
nb::list toDicts(const Explanation& explanation);

}  // namespace kinegraph::python
