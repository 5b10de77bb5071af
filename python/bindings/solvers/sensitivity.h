#pragma once

#include "bindings.h"
#include "kinegraph/ik/solve_ik.h"
#include "kinegraph/solvers/interface/result.h"

namespace kinegraph::python {

/// result.sensitivity(...), and what it gives.
void bindSensitivity(nb::module_& m, nb::class_<SolverResult>& result);
void bindSensitivity(nb::class_<IkResult>& result);

}  // namespace kinegraph::python
