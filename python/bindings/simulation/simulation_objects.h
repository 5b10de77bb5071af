#pragma once

#include <optional>

#include "bindings.h"
#include "kinegraph/simulation/simulation.h"

namespace kinegraph::python {

/// What Python calls a Simulation; it keeps the Config's object, and so its viewer, alive.
struct PySimulation {
  nb::object config;
  Simulation simulation;
};

void bindSimulation(nb::module_& m);
void bindRecording(nb::module_& m, nb::class_<PySimulation>& simulation);
void bindSimulationView(nb::class_<PySimulation>& simulation);
void bindSimulationBatch(nb::module_& m);

/// Shows it live as `verbose` says: 2 or more: yes, and a page opens; less: no; None: if the page of its Config is open.
void applyVerbosity(PySimulation& s, const std::optional<int>& verbose);

/// Options as a user gives them: SimulationOptions, a dict of fields, or None.
SimulationOptions optionsFrom(nb::handle given);

}  // namespace kinegraph::python
