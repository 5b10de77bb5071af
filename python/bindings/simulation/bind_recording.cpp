#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include <utility>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/api/recorded_motion.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "simulation/simulation_docs.h"
#include "simulation/simulation_objects.h"
#include "viewer/notebook_page.h"
#include "viewer/py_viewer.h"

namespace kinegraph::python {

namespace {

/// A recording with its own viewer.
struct PyRecording : Recording {
  std::shared_ptr<PyViewer> viewer = {};
};

int viewRecording(PyRecording& recording, bool pause, const std::optional<std::string>& message) {
  const ShownMotion motion = recordedMotion(recording);
  const Config config = recording.makeConfig();
  if (!recording.viewer) recording.viewer = std::make_shared<PyViewer>();
  const std::shared_ptr<PyViewer> viewer = recording.viewer;
  viewer->scene = config.scene();
  if (!viewer->isOpen()) viewer->setTitle("Simulation");
  if (!openPage(*viewer)) return pause ? kEscape : 0;
  const nb::gil_scoped_release unlock;
  return viewer->showMotion(config, motion, pause, message, interrupted);
}

void recordSimulationTo(nb::handle self, const PathText& path, double rate, nb::handle cameras, double camera_rate,
                        double start) {
  PySimulation& simulation = nb::cast<PySimulation&>(self);
  if (simulation.recorder.is_valid()) {
    const nb::object ended = std::exchange(simulation.recorder, nb::object());
    ended.attr("close")();
  }
  if (path.text.empty()) return;
  simulation.recorder =
      nb::module_::import_("kinegraph.recording")
          .attr("recordSimulation")(self, simulation.config, path.text, rate, cameras, camera_rate, start);
}

}  // namespace

void bindRecording(nb::module_& m, nb::class_<PySimulation>& simulation) {
  nb::class_<PyRecording>(m, "SimulationRecording", docs::simulation::recording)
      .def_prop_ro(
          "times", [](const PyRecording& r) { return toNumpy(r.times.data(), r.times.size()); },
          "s after each step, (T,).")
      .def_prop_ro(
          "q",
          [](const PyRecording& r) {
            MatrixXd path(long(r.q.size()), r.q.empty() ? 0 : r.q[0].size());
            for (long i = 0; i < path.rows(); ++i) path.row(i) = r.q[std::size_t(i)].transpose();
            return toNumpy(path);
          },
          "Joint state after each step, (T, n).")
      .def_prop_ro(
          "freePos",
          [](const PyRecording& r) {
            const std::size_t free = r.freePos.empty() ? 0 : std::size_t(r.freePos[0].rows());
            const NewArray made = newArray(r.freePos.size(), free, 7);
            double* at = made.data;
            for (const MatrixXd& poses : r.freePos) {
              for (long i = 0; i < poses.rows(); ++i) {
                for (long k = 0; k < 7; ++k) *at++ = poses(i, k);
              }
            }
            return made.array;
          },
          "Poses of the free frames after each step, (T, F, 7).")
      .def_ro("isCut", &PyRecording::is_cut, "A change of the scene's structure ended the recording.")
      .def(
          "save", [](const PyRecording& r, const PathText& path) { r.save(path.text); }, "path"_a,
          docs::simulation::save)
      .def_static(
          "load", [](const PathText& path) { return PyRecording{Recording::load(path.text)}; }, "path"_a,
          docs::simulation::load)
      .def(
          "makeConfig", [](const PyRecording& r) { return PyConfig{r.makeConfig()}; }, docs::simulation::makeConfig)
      .def(
          "replay",
          [](const PyRecording& r, nb::object config) {
            Simulation again = r.replay(nb::cast<PyConfig&>(config));
            return new PySimulation{std::move(config), std::move(again)};
          },
          "C"_a, nb::sig("def replay(self, C: Config) -> Simulation"), docs::simulation::replay)
      .def("view", viewRecording, "pause"_a = false, "message"_a = nb::none(), docs::simulation::viewRecording)
      .def(
          "saveHtml",
          [](const PyRecording& r, const PathText& path, const std::optional<PathText>& client) {
            if (client && client->text.empty()) throw ValueError("saveHtml: client is empty; expected a path, or None");
            r.saveHtml(path.text, client ? client->text : "");
          },
          "path"_a, "client"_a = nb::none(), docs::simulation::saveHtml)
      .def(
          "viewer",
          [](PyRecording& r) {
            if (!r.viewer) r.viewer = std::make_shared<PyViewer>();
            return r.viewer;
          },
          "The viewer of this recording.")
      .def(
          "view_close",
          [](PyRecording& r) {
            if (r.viewer) r.viewer->close();
          },
          "Closes the viewer.")
      .def(
          "_repr_html_",
          [](const PyRecording& r) -> std::optional<std::string> {
            if (r.times.empty()) return std::nullopt;
            const ShownMotion motion = recordedMotion(r);
            return notebookPage(r.makeConfig(), &motion, "Simulation", "");
          },
          "Returns a page for notebooks that plays the recording without a running program.")
      .def("__repr__", [](const PyRecording& r) {
        return cat("<SimulationRecording of ", r.times.size(), " steps, ", r.calls.size(), " calls>");
      });
  using S = PySimulation;
  simulation
      .def(
          "startRecording", [](S& s) { s.simulation.startRecording(); }, docs::simulation::startRecording)
      .def(
          "stopRecording", [](S& s) { return PyRecording{s.simulation.stopRecording()}; },
          docs::simulation::stopRecording)
      .def("recordTo", recordSimulationTo, "path"_a, nb::kw_only(), "rate"_a = 100., "cameras"_a = nb::make_tuple(),
           "camera_rate"_a = 20., "start"_a = 0.,
           nb::sig(
               "def recordTo(self, path: str | os.PathLike[str], *, rate: float = 100.0, "
               "cameras: collections.abc.Sequence[str] = (), camera_rate: float = 20.0, start: float = 0.0) -> None"),
           docs::simulation::recordTo);
}

}  // namespace kinegraph::python
