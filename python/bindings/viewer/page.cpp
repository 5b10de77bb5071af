#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "parameters.h"
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

/// Sets the initial camera to a frame `camera_init`, if there is one. Returns whether it has just been set.
bool startCamera(PyViewer& viewer) {
  FrameData* init = viewer.scene && !viewer.camera_is_set ? viewer.scene->find("camera_init") : nullptr;
  if (!init) return false;
  viewer.camera.place(cameraOf(Frame(viewer.scene, *init)));
  viewer.camera_is_set = true;
  return true;
}

/// Sets the camera of the pages, if it has changed.
void aimPage(PyViewer& viewer, bool is_new) {
  const bool started = startCamera(viewer);
  const Camera camera = cameraNow(viewer);
  if (started || viewer.camera.follows()) {
    const PageCamera page = pageCameraOf(camera);
    const bool same = viewer.page_camera && page.pose.numbers().isApprox(viewer.page_camera->pose.numbers(), 1e-12);
    if (is_new || !same) viewer.aim(page);
  } else if (is_new && viewer.page_camera) {
    viewer.aim(*viewer.page_camera);
  }
}

}  // namespace

bool interrupted() {
  checkInterrupt();
  return false;
}

void PyViewer::aim(const PageCamera& from) {
  page_camera = from;
  if (from.distance > 0.) distance = from.distance;
  if (isOpen()) setCamera(from);
}

void PyViewer::endPage() {
  close();
  camera.place(defaultViewCamera());
  camera_is_set = visuals_only = false;
  page_camera.reset();
  distance = PageCamera{}.distance;
  quads.clear();
}

Appearance appearanceFromParameters() {
  Appearance appearance;
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
  return appearance;
}

PageCamera pageCameraOf(const Camera& camera) {
  PageCamera page{camera.pose};
  page.focal_length = camera.focal_length;
  page.ortho_height = camera.ortho_height;
  page.aspect = double(camera.width) / camera.height;
  if (camera.has_range) {
    page.near = camera.near;
    page.far = camera.far;
  }
  return page;
}

Camera cameraNow(PyViewer& viewer) {
  startCamera(viewer);
  FrameData* tracked = viewer.scene ? viewer.scene->find("camera_track") : nullptr;
  const std::optional<PageCamera> moved = viewer.takeViewpoint();
  if (tracked) {
    viewer.camera.follow(Frame(viewer.scene, *tracked));
    viewer.camera_is_set = true;
  } else if (moved) {
    Camera camera = viewer.camera.now();
    camera.pose = moved->pose;
    camera.focal_length = moved->focal_length;
    camera.ortho_height = moved->ortho_height;
    viewer.camera.place(camera);
    viewer.camera_is_set = true;
    if (moved->distance > 0.) viewer.distance = moved->distance;
  }
  return viewer.camera.now();
}

bool openPage(PyViewer& viewer) {
  if (flag("disableGui", false)) return false;
  viewer.setWaits(!flag("noInteractivity", false));
  Appearance appearance = appearanceFromParameters();
  appearance.visuals_only = viewer.visuals_only;
  const bool is_new = !viewer.isOpen();
  viewer.server().setAppearance(appearance);
  if (viewer.scene) aimPage(viewer, is_new);
  if (is_new) {
    for (const auto& [id, quad] : viewer.quads) viewer.server().setQuad(quad);
    nb::module_::import_("kinegraph.notebook").attr("showInline")(viewer.url());
  }
  return true;
}

bool show(PyViewer& viewer, const std::optional<std::string>& message, bool offscreen) {
  if (message) viewer.storeMessage(*message);
  return !offscreen && openPage(viewer);
}

}  // namespace kinegraph::python
