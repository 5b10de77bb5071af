#pragma once

#include <string>

#include "bindings.h"
#include "kinegraph/solvers/nlp_solver.h"

namespace kinegraph::python {

using Conflicts = nb::typed<nb::list, nb::typed<nb::dict, nb::str, nb::any>>;

/// What `explain` returns, in the names of Python.
std::string textOf(const Explanation& explanation);

/// A dict per conflict; lengths or angles that it does not have are None.
Conflicts toDicts(const Explanation& explanation);

}  // namespace kinegraph::python
