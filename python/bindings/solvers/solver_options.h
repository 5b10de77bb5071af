#pragma once

#include "kinegraph/solvers/interface/options.h"
#include "option_class.h"

namespace kinegraph::python {

/// How Python sets the options of solvers. Names of older packages without meaning here are ignored.
const OptionClass<SolverOptions, OptMethod>& solverOptions();

void bindSolverOptions(nb::module_& m);

}  // namespace kinegraph::python
