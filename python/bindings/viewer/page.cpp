#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>

#include "kinegraph/viewer/recorded_page.h"
#include "parameters.h"
#include "viewer/notebook_page.h"
#include "viewer/py_viewer.h"

namespace kinegraph::python {

namespace {

bool flag(const char* name, bool otherwise) {
  const nb::object value = parameter(name, nb::object(nb::bool_(otherwise)), "");
  if (!PyLong_Check(value.ptr())) {  // True and False are numbers, too
    throw ValueError(
        cat("parameter ", name, " is ", nb::cast<std::string>(nb::repr(value)), "; expected True or False"));
  }
  return nb::cast<bool>(nb::bool_(value));
}

std::vector<double> numbers(const char* name) { return parameter(name, std::vector<double>(), "a list of numbers"); }

/// Returns the motion with fewer slices, equally far apart, such that they have at most about `most` poses.
ShownMotion thinned(const ShownMotion& motion, std::size_t most) {
  const std::size_t slices = motion.poses.size();
  const std::size_t kept =
      slices < 2 ? slices : std::clamp<std::size_t>(most / std::max<std::size_t>(motion.poses[0].size(), 1), 2, slices);
  if (kept == slices) return motion;
  ShownMotion fewer;
  fewer.seconds = motion.seconds;
  fewer.start = motion.start;
  fewer.q.resize(motion.q.rows() > 0 ? Eigen::Index(kept) : 0, motion.q.cols());
  for (std::size_t i = 0; i < kept; ++i) {
    const std::size_t from = i * (slices - 1) / (kept - 1);
    fewer.poses.push_back(motion.poses[from]);
    if (fewer.q.rows() > 0) fewer.q.row(Eigen::Index(i)) = motion.q.row(Eigen::Index(from));
    if (!motion.texts.empty()) fewer.texts.push_back(motion.texts[from]);
  }
  return fewer;
}

}  // namespace

bool interrupted() {
  checkInterrupt();
  return false;
}

void takeAppearance(PyViewer& viewer) {
  Appearance appearance;
  appearance.visuals_only = viewer.appearance().visuals_only;
  const std::vector<double> background = numbers("Render/backgroundColor"), floor = numbers("Render/floorColor");
  const std::vector<double> lights = numbers("Render/lights");
  if (background.size() == 3) appearance.background = Vector3d(background.data());
  if (floor.size() == 3) appearance.floor = Vector3d(floor.data());
  appearance.has_floor = floor.empty() || floor.size() == 3;
  appearance.shadows = flag("Render/renderShadow", true);
  appearance.text = flag("Render/renderText", true);
  appearance.flat_colors = flag("Render/flatColors", false);
  appearance.wireframe = flag("Render/renderPolygonLines", false);
  if (lights.size() % 3 != 0) {
    throw ValueError(
        cat("parameter Render/lights has ", lights.size(), " numbers; expected the 3 coordinates (m) of each light"));
  }
  for (std::size_t i = 0; i < lights.size(); i += 3) appearance.lights.emplace_back(&lights[i]);
  viewer.setAppearance(appearance);
}

bool openPage(PyViewer& viewer) {
  if (flag("disableGui", false)) return false;
  viewer.setWaits(!flag("noInteractivity", false));
  takeAppearance(viewer);
  const bool is_new = !viewer.isOpen();
  viewer.server();
  if (viewer.scene) viewer.pictures().aimPage();
  if (is_new) nb::module_::import_("kinegraph.notebook").attr("showInline")(viewer.url());
  return true;
}

bool show(PyViewer& viewer, const std::optional<std::string>& message, bool offscreen) {
  if (message) viewer.storeMessage(*message);
  return !offscreen && openPage(viewer);
}

std::string notebookPage(const Config& config, const ShownMotion* motion, const std::string& title,
                         const std::string& text) {
  constexpr std::size_t kMostPoses = 8000;
  ShownMotion shown;
  if (motion) shown = thinned(*motion, kMostPoses);
  const std::string page = recordedScene(config, motion ? &shown : nullptr, title, nullptr, kLargestInNotebooks);
  const nb::module_ notebook = nb::module_::import_("kinegraph.notebook");
  return nb::cast<std::string>(notebook.attr("inlineFrame")(page, text));
}

}  // namespace kinegraph::python
