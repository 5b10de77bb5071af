#pragma once

#include <optional>

#include "bindings.h"
#include "kinegraph/simulation/simulation.h"

namespace kinegraph::python {

/// The Python object of a Simulation; it keeps the Config's object, and so its viewer, alive.
struct PySimulation {
  nb::object config;
  Simulation simulation;
  nb::object recorder{};  ///< of `recordTo`, if any; it does not refer to the simulation
};

void bindSimulation(nb::module_& m);
void bindRecording(nb::module_& m, nb::class_<PySimulation>& simulation);
void bindSimulationView(nb::class_<PySimulation>& simulation);
void bindSimulationBatch(nb::module_& m);

/// Opens or closes the live view: 2 or more opens a page; less closes it; None: live if the Config's page is open.
void applyVerbosity(PySimulation& s, const std::optional<int>& verbose);

/// Converts a user's options: SimulationOptions, a dict of fields, or None.
SimulationOptions optionsFrom(nb::handle given);

}  // namespace kinegraph::python
