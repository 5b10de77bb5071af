#pragma once

#include "bindings.h"
#include "kinegraph/simulation/simulation_options.h"

namespace kinegraph::python {

void bindSimulation(nb::module_& m);
void bindSimulationBatch(nb::module_& m);

/// Options as a user gives them: SimulationOptions, a dict of fields, or None.
SimulationOptions optionsFrom(nb::handle given);

}  // namespace kinegraph::python
