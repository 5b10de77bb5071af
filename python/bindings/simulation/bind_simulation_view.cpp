#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <cmath>
#include <limits>

#include "bindings.h"
#include "kinegraph/api/simulation_view.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "simulation/simulation_docs.h"
#include "simulation/simulation_objects.h"
#include "viewer/py_viewer.h"

namespace kinegraph::python {

namespace {

/// Releases the interpreter lock while it waits.
struct PySimulationView final : SimulationView {
  using SimulationView::SimulationView;
  void rest() override {
    std::optional<nb::gil_scoped_release> unlock;
    if (PyGILState_Check()) unlock.emplace();
    SimulationView::rest();
  }
};

PyConfig& configOf(PySimulation& s) { return nb::cast<PyConfig&>(s.config); }

const std::shared_ptr<PyViewer>& viewerOf(PySimulation& s) {
  PyConfig& config = configOf(s);
  if (!config.viewer) config.viewer = std::make_shared<PyViewer>();
  config.viewer->scene = config.scene();
  return config.viewer;
}

/// Returns the view on the page of C, created if necessary; null if pages are disabled.
std::shared_ptr<SimulationView> liveView(PySimulation& s) {
  const std::shared_ptr<PyViewer>& viewer = viewerOf(s);
  if (!openPage(*viewer)) return nullptr;
  if (auto view = SimulationView::of(s.simulation, viewer)) return view;
  return SimulationView::begin<PySimulationView>(s.simulation, viewer, checkInterrupt);
}

int viewSimulation(PySimulation& s, bool pause, const std::optional<std::string>& message) {
  const std::shared_ptr<SimulationView> live = liveView(s);
  if (!live) return pause ? kEscape : 0;
  const nb::gil_scoped_release unlock;
  return live->view(s.simulation, pause, message);
}

int run(PySimulation& s, const std::optional<double>& seconds, double tau, double speed) {
  const auto observer = std::dynamic_pointer_cast<SimulationView>(s.simulation.observer());
  const bool can_end = observer && viewerOf(s)->isOpen() && viewerOf(s)->waits();
  if (!seconds && !can_end)
    throw ValueError(
        "Simulation.run: seconds is None, but no page is open on which a key could end the run; "
        "pass seconds, or call view() first");
  const nb::gil_scoped_release unlock;
  CheckInterrupts check;
  return s.simulation.run(seconds.value_or(std::numeric_limits<double>::infinity()), tau, speed, [&] { check(); });
}

}  // namespace

void applyVerbosity(PySimulation& s, const std::optional<int>& verbose) {
  const std::shared_ptr<PyViewer>& viewer = configOf(s).viewer;
  if (verbose ? *verbose >= 2 : viewer && viewer->isOpen()) {
    viewSimulation(s, false, std::nullopt);
  } else {
    s.simulation.setObserver(nullptr);
  }
}

void bindSimulationView(nb::class_<PySimulation>& simulation) {
  simulation.def("view", viewSimulation, "pause"_a = false, "message"_a = nb::none(), docs::simulation::view)
      .def(
          "view_close",
          [](PySimulation& s) {
            s.simulation.setObserver(nullptr);
            if (configOf(s).viewer) configOf(s).viewer->close();
          },
          docs::simulation::view_close)
      .def("run", run, "seconds"_a = nb::none(), "tau"_a = .01, "speed"_a = 1., docs::simulation::run);
}

}  // namespace kinegraph::python
