#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <thread>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/komo/report.h"
#include "py_komo.h"
#include "py_viewer.h"

namespace kinegraph::python {

namespace {

using Message = const std::optional<std::string>&;

nb::dict specs(const PyKomo& komo) {
  nb::dict out;
  out["x_dim"] = komo.layout().dimension;
  out["dual_dim"] = 0;
  out["T"] = komo.slices();
  out["k"] = komo.order();
  out["phases"] = komo.phases();
  out["slicesPerPhase"] = komo.slicesPerPhase();
  out["tau"] = komo.tau();
  out["#slices"] = komo.slices() + komo.order();
  out["#totalDOF"] = komo.layout().dimension;
  out["#frames"] = (komo.slices() + komo.order()) * komo.frameCount();
  return out;
}

nb::dict entryOf(const Komo::Objective& objective, double error) {
  nb::dict entry;
  entry["name"] = objective.name;
  std::vector<std::string> frames = objective.frames;
  if (frames.size() > 3) frames = {cat("#", frames.size())};
  entry["frames"] = frames;
  entry["err"] = error;
  entry["order"] = objective.order;
  entry["type"] = objectiveTypeName(objective.type);
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> scale = objective.scale;
  entry["scale"] = toNumpy(scale.data(), std::size_t(scale.size()));
  entry["target"] = toNumpy(objective.target);
  entry["times"] = objective.times;
  entry["slices"] = std::vector<int>{objective.from, objective.to};
  return entry;
}

nb::dict report(const PyKomo& komo, bool with_specs, bool list_objectives, bool plot, bool sort) {
  if (plot) emitWarning("KOMO.report: plots are not available; info_objectiveErrorTraces() has the numbers");
  const PathErrors errors = measurePath(komo);
  nb::dict out;
  if (with_specs) out["specs"] = specs(komo);
  if (list_objectives) {
    std::vector<std::size_t> order(komo.objectives().size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    if (sort) std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return errors.per_objective[a] < errors.per_objective[b]; });
    for (std::size_t o : order) out[cat("o", o).c_str()] = entryOf(komo.objectives()[o], errors.per_objective[o]);
  }
  nb::dict totals;
  totals["sos"] = errors.totals.sos;
  totals["ineq"] = errors.totals.ineq;
  totals["eq"] = errors.totals.eq;
  totals["f"] = errors.totals.f;
  out["totals"] = totals;
  return out;
}

std::vector<std::string> objectiveTags(const PyKomo& komo) {
  std::vector<std::string> tags;
  for (const Komo::Objective& objective : komo.objectives()) tags.push_back(objectiveTag(komo, objective));
  return tags;
}

int show(PyKomo& komo, const Config& config, bool pause, const std::string& text) {
  if (!komo.viewer) komo.viewer = std::make_shared<PyViewer>();
  const std::shared_ptr<PyViewer> viewer = komo.viewer;
  viewer->scene = config.scene();
  const nb::gil_scoped_release unlock;
  return viewer->view(config, pause, text, [] {
    checkInterrupt();
    return false;
  });
}

int view(PyKomo& komo, bool pause, Message text) {
  Config all;
  for (int t = 0; t < komo.slices(); ++t) all.addConfigurationCopy(komo.configuration(t), t == 0 ? "" : cat("slice", t, "_"));
  return show(komo, all, pause, text.value_or(cat("all ", komo.slices(), " slices")));
}

int viewSlice(PyKomo& komo, int slice, bool pause) { return show(komo, komo.configuration(slice), pause, cat("slice ", slice)); }

int viewPlay(PyKomo& komo, bool pause, Message text, double delay, const std::optional<std::string>& video) {
  if (video) throw ValueError("view_play: saving a video is not available");
  int key = 0;
  for (int t = 0; t < komo.slices(); ++t) {
    key = show(komo, komo.configuration(t), pause && t + 1 == komo.slices(), cat(text.value_or(""), " slice ", t));
    const nb::gil_scoped_release unlock;
    std::this_thread::sleep_for(std::chrono::duration<double>(std::clamp(delay, 0., 10.)));
    checkInterrupt();
  }
  return key;
}

}  // namespace

void bindKomoReports(nb::class_<PyKomo>& komo) {
  komo.def("report", report, "specs"_a = false, "listObjectives"_a = true, "plotOverTime"_a = false, "sortByError"_a = true,
           "The objectives with their errors at the present path, smallest first, and the sums, as a dict.")
      .def("getReport", [](const PyKomo& k, nb::args, nb::kwargs) { return report(k, false, true, false, true); }, "The same as report().")
      .def("getFeatureNames", [](const PyKomo& k) { return residualTags(k); }, "A short name per residual.")
      .def("info_objectiveNames", objectiveTags, "A short name per objective.")
      .def("info_objectiveErrorTraces", [](const PyKomo& k) { return toNumpy(measurePath(k).per_slice); }, "(T, objectives): errors by slice.")
      .def("info_sliceErrors", [](const PyKomo& k, int t, const Numbers& traces) { return sliceErrors(k, t, traces.matrix()); }, "t"_a,
           "errorTraces"_a, "The objectives with errors in a slice, largest first, a line each.")
      .def("info_sliceCollisions", [](const PyKomo& k, int t, double margin) { return sliceCollisions(k, t, margin); }, "t"_a,
           "belowMargin"_a, "The pairs of shapes nearer than a margin in a slice, a line each.")
      .def("view", view, "pause"_a = false, "txt"_a = nb::none(), "Shows all slices at once, in the browser.")
      .def("view_slice", viewSlice, "t"_a, "pause"_a = false, "Shows a slice.")
      .def("view_play", viewPlay, "pause"_a = false, "txt"_a = nb::none(), "delay"_a = .1, "saveVideoPath"_a = nb::none(),
           "Shows one slice after the other.")
      .def("view_close", [](PyKomo& k) { if (k.viewer) k.viewer->close(); }, "Ends the viewer.")
      .def("get_viewer", [](PyKomo& k) {
             if (!k.viewer) k.viewer = std::make_shared<PyViewer>();
             return k.viewer;
           }, "The viewer of this problem.")
      .def("set_viewer", [](PyKomo& k, std::shared_ptr<PyViewer> viewer) { k.viewer = std::move(viewer); }, "viewer"_a,
           "Shows this problem in another one's viewer.");
}

}  // namespace kinegraph::python
