#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <thread>

#include "arguments.h"
#include "kinegraph/api/komo_motion.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/objective.h"
#include "kinegraph/komo/objective_list.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/viewer/recorded_page.h"
#include "komo/komo_reports_docs.h"
#include "komo/py_komo.h"
#include "viewer/py_viewer.h"

namespace kinegraph::python {

namespace {

using Message = const std::optional<std::string>&;

nb::dict specs(const PyKomo& komo) {
  nb::dict out;
  out["x_dim"] = komo.path().layout().dimension;
  out["dual_dim"] = 0;
  out["T"] = komo.slices();
  out["k"] = komo.order();
  out["phases"] = komo.path().grid().phases();
  out["slicesPerPhase"] = komo.path().grid().slicesPerPhase();
  out["tau"] = komo.tau();
  out["#slices"] = komo.slices() + komo.order();
  out["#totalDOF"] = komo.path().layout().dimension;
  out["#frames"] = (komo.slices() + komo.order()) * int(komo.path().shownFrames().size());
  return out;
}

nb::dict entryOf(const Objective& objective, double error) {
  nb::dict entry;
  entry["name"] = objective.name();
  std::vector<std::string> frames = objective.frames;
  if (frames.size() > 3) frames = {cat("#", frames.size())};
  entry["frames"] = frames;
  entry["err"] = error;
  entry["order"] = objective.order;
  entry["type"] = objectiveTypeName(objective.type);
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> scale = objective.scale;
  entry["scale"] = std::vector<double>(scale.data(), scale.data() + scale.size());  // lists, as JSON takes them
  entry["target"] = std::vector<double>(objective.target.data(), objective.target.data() + objective.target.size());
  entry["times"] = objective.times;
  entry["slices"] = std::vector<int>{objective.from, objective.to};
  return entry;
}

Attributes report(const PyKomo& komo, bool with_specs, bool list_objectives, bool plot, bool sort) {
  if (plot) emitWarning("KOMO.report: plots are not available; info_objectiveErrorTraces() returns the numbers");
  const PathErrors errors = measurePath(komo);
  Attributes out;
  if (with_specs) out["specs"] = specs(komo);
  if (list_objectives) {
    std::vector<std::size_t> order(komo.objectives().size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    if (sort)
      std::stable_sort(order.begin(), order.end(),
                       [&](std::size_t a, std::size_t b) { return errors.per_objective[a] < errors.per_objective[b]; });
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
  for (const Objective& objective : komo.objectives()) tags.push_back(objectiveTag(komo, objective));
  return tags;
}

std::shared_ptr<PyViewer> viewerOf(PyKomo& komo) {
  if (!komo.viewer) komo.viewer = std::make_shared<PyViewer>();
  try {
    if (!komo.viewer->scene) komo.viewer->scene = komo.configuration(-komo.order()).scene();
  } catch (const Error&) {  // without a configuration and a timing there is nothing to show yet
  }
  return komo.viewer;
}

/// Shows a motion. Pictures (getRgb) show the scene in the slice `pictured`.
int show(PyKomo& komo, const ShownMotion& motion, bool pause, const std::string& text, int pictured) {
  const std::shared_ptr<PyViewer> viewer = viewerOf(komo);
  const Config config = komo.configuration(-komo.order());
  viewer->scene = komo.configuration(pictured).scene();
  if (!viewer->isOpen()) viewer->setTitle("KOMO Viewer");
  if (!openPage(*viewer)) return pause ? kEscape : 0;
  const nb::gil_scoped_release unlock;
  return viewer->showMotion(config, motion, pause, text, interrupted);
}

int viewKomo(PyKomo& komo, bool pause, Message text) {
  return show(komo, motionOf(komo), pause, text.value_or(cat("all ", komo.slices() + komo.order(), " slices")),
              -komo.order());
}

int viewSlice(PyKomo& komo, int slice, bool pause) {
  if (slice < -komo.order() || slice >= komo.slices()) {
    throw ValueError(cat("view_slice: t is ", slice, "; expected 0 to ", komo.slices() - 1, ", or ", -komo.order(),
                         " to -1 before the path"));
  }
  ShownMotion motion = motionOf(komo);
  motion.start = ShownMotion::Start::pause;
  motion.first = slice + komo.order();
  return show(komo, motion, pause, cat("slice ", slice), slice);
}

/// Saves a picture of each slice as PREFIX000000.png and so on, without a browser, with the page's text for the slice.
void savePictures(PyKomo& komo, const std::string& prefix, const std::vector<std::string>& texts) {
  const std::shared_ptr<PyViewer> viewer = viewerOf(komo);
  nb::module_::import_("kinegraph.png").attr("removeNumbered")(prefix);
  for (int t = -komo.order(); t < komo.slices(); ++t) {
    viewer->scene = komo.configuration(t).scene();
    const std::string& text = texts[std::size_t(t + komo.order())];
    const std::string title = cat("slice ", t, "/", komo.slices(), text.empty() ? "" : "\n", text);
    savePicture(*viewer, prefix, t + komo.order(), title);
    checkInterrupt();
  }
}

int viewPlay(PyKomo& komo, bool pause, Message text, double delay, const std::optional<std::string>& video) {
  ShownMotion motion = motionOf(komo);
  if (video) savePictures(komo, *video, motion.texts);
  motion.start = ShownMotion::Start::play;
  const auto count = motion.poses.size();
  motion.seconds = std::clamp(delay, .01, 10.) * double(count);
  return show(komo, motion, pause, text.value_or(cat(count, " slices")), komo.slices() - 1);
}

}  // namespace

void bindKomoReports(nb::class_<PyKomo>& komo) {
  komo.def("report", report, "specs"_a = false, "listObjectives"_a = true, "plotOverTime"_a = false,
           "sortByError"_a = true, docs::komo_reports::report)
      .def(
          "getFeatureNames", [](const PyKomo& k) { return residualTags(k); }, "Returns a short name per residual.")
      .def("info_objectiveNames", objectiveTags, "Returns a short name per objective.")
      .def(
          "info_objectiveErrorTraces", [](const PyKomo& k) { return toNumpy(measurePath(k).per_slice); },
          "Returns the errors of the objectives by slice, shape (T, objectives).")
      .def(
          "info_sliceErrors",
          [](const PyKomo& k, int t, const Numbers& traces) { return sliceErrors(k, t, traces.matrix()); }, "t"_a,
          "errorTraces"_a, docs::komo_reports::info_sliceErrors)
      .def(
          "info_sliceCollisions", [](const PyKomo& k, int t, double margin) { return sliceCollisions(k, t, margin); },
          "t"_a, "belowMargin"_a, docs::komo_reports::info_sliceCollisions)
      .def("view", viewKomo, "pause"_a = false, "txt"_a = nb::none(), docs::komo_reports::view)
      .def("view_slice", viewSlice, "t"_a, "pause"_a = false, docs::komo_reports::view_slice)
      .def("view_play", viewPlay, "pause"_a = false, "txt"_a = nb::none(), "delay"_a = .1,
           "saveVideoPath"_a = nb::none(), docs::komo_reports::view_play)
      .def(
          "_repr_html_",
          [](const PyKomo& k) {
            const ShownMotion motion = motionOf(k);
            const std::string page =
                recordedScene(k.configuration(-k.order()), &motion, "KOMO Viewer", nullptr, kLargestInNotebooks);
            return nb::cast<std::string>(nb::module_::import_("kinegraph.notebook").attr("inlineFrame")(page));
          },
          "Returns a page for notebooks that plays the motion without a running program.")
      .def(
          "view_close",
          [](PyKomo& k) {
            if (k.viewer) k.viewer->close();
          },
          "Closes the viewer.")
      .def("viewer", viewerOf, "Returns the viewer of this problem.")
      .def("get_viewer", viewerOf, "Returns the viewer of this problem, as viewer() does.")
      .def(
          "set_viewer", [](PyKomo& k, std::shared_ptr<PyViewer> viewer) { k.viewer = std::move(viewer); }, "viewer"_a,
          docs::komo_reports::set_viewer);
}

}  // namespace kinegraph::python
