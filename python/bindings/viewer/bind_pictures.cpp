#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <set>

#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/rendering/camera_renderer.h"
#include "kinegraph/rendering/letters.h"
#include "kinegraph/viewer/draw_quad.h"
#include "rendering/images.h"
#include "viewer/pictures_docs.h"
#include "viewer/py_viewer.h"

namespace kinegraph::python {

namespace {

/// Renders the viewer's scene, with a text on it. Without depths, unless asked for.
CameraImage picture(PyViewer& viewer, const std::string& text, bool has_depth = false) {
  if (!viewer.scene) throw ValueError("this viewer has no scene yet; call view() first");
  const Camera camera = cameraNow(viewer);
  const Appearance appearance = appearanceFromParameters();
  PictureOptions options{.has_floor = appearance.has_floor,
                         .shadows = appearance.shadows,
                         .background = appearance.background,
                         .floor_color = appearance.floor,
                         .lights = appearance.lights,
                         .flat_colors = appearance.flat_colors,
                         .wireframe = appearance.wireframe,
                         .distance = viewer.distance,
                         .has_depth = has_depth};
  if (!viewer.pictures) viewer.pictures.emplace();
  const nb::gil_scoped_release unlock;
  CameraImage image = viewer.pictures->render(*viewer.scene, camera, options, viewer.visuals_only);
  for (const auto& [id, quad] : viewer.quads) drawQuad(image.rgb, image.width, quad);
  if (appearance.text && !viewer.visuals_only && !text.empty()) {
    constexpr int kAround = 48;  // pixels of width and height that the text does not use
    const int width = std::max(image.width - kAround, 1), height = std::max(image.height - kAround, 1);
    if (!viewer.letters) viewer.letters.emplace();
    drawLetters(image.rgb, image.width, viewer.letters->write(text, width, height));
  }
  return image;
}

/// Turns the camera to a point, and moves it such that `height` m fit into the picture there.
void focus(PyViewer& viewer, const Numbers& at, double height) {
  if (at.values.size() != 3) throw ValueError(cat("focus: position_3d has ", at.values.size(), " entries; expected 3"));
  if (!(height > 0. && std::isfinite(height)))
    throw ValueError(cat("focus: heightAbs is ", height, " m; expected a positive number"));
  Camera camera = cameraNow(viewer);
  const Vector3d point(at.values), back = camera.pose.p - point;
  if (back.norm() < 1e-9) throw ValueError("focus: the camera is at that position");
  camera.pose = lookAt(point + height * camera.focal_length * back.normalized(), point);
  viewer.camera.place(camera);
  viewer.camera_is_set = true;
  PageCamera page = pageCameraOf(camera);
  page.distance = height * camera.focal_length;
  viewer.aim(page);
}

/// Sets the camera of pictures and pages.
void placeCamera(PyViewer& viewer, const Camera& camera) {
  viewer.camera.place(camera);
  viewer.camera_is_set = true;
  viewer.aim(pageCameraOf(camera));
}

void setViewCamera(PyViewer& viewer, nb::handle frame) {
  if (frame.is_none()) return placeCamera(viewer, defaultViewCamera());
  std::optional<Frame> given;
  if (nb::isinstance<Frame>(frame))
    given = nb::cast<Frame>(frame);
  else if (viewer.scene)
    given = Frame(viewer.scene, viewer.scene->get(nb::cast<std::string>(frame), "setCamera"));
  else
    throw ValueError("this viewer has no scene yet; pass a Frame instead of its name, or call view() first");
  placeCamera(viewer, cameraOf(*given));
  viewer.camera.follow(*given);
}

void setCameraTarget(PyViewer& viewer, const Numbers& position, const Numbers& target) {
  if (position.values.size() != 3 || target.values.size() != 3) {
    throw ValueError("setCamera: position and target need 3 entries each");
  }
  const Vector3d from(position.values), to(target.values);
  Camera camera = cameraNow(viewer);
  camera.pose = lookAt(from, to);
  viewer.camera.place(camera);
  viewer.camera_is_set = true;
  viewer.aim({.pose = camera.pose,
              .distance = (to - from).norm(),
              .focal_length = camera.focal_length,
              .ortho_height = camera.ortho_height,
              .aspect = 1.});
}

/// Moves the camera such that the visible scene fills the picture. Returns the scene's center; 0 without a visible
/// shape.
Array fit(PyViewer& viewer) {
  if (!viewer.scene) throw ValueError("this viewer has no scene yet; call view() first");
  const Config config(viewer.scene);
  const Camera camera = fitted(cameraNow(viewer), config);
  placeCamera(viewer, camera);
  const std::optional<ShownBall> ball = shownBall(config);
  if (ball) {
    PageCamera page = pageCameraOf(camera);
    page.distance = (ball->center - camera.pose.p).norm();
    viewer.aim(page);
  }
  return toNumpy(VectorXd(ball ? ball->center : Vector3d::Zero()));
}

/// Endings of pictures and films in other formats, which are no prefixes.
const std::set<std::string> kOtherPictures = {".jpg",  ".jpeg", ".gif", ".bmp", ".tif", ".tiff",
                                              ".webp", ".svg",  ".pdf", ".ppm", ".mp4", ".webm"};

}  // namespace

std::string savePicture(PyViewer& viewer, const std::string& path, int count, const std::optional<std::string>& text) {
  if (const std::string suffix = lowerExtension(path); kOtherPictures.contains(suffix))
    throw ValueError(cat("savePng: '", path, "' ends in ", suffix, ", but pictures are saved as PNG; end it in .png"));
  CameraImage image = picture(viewer, text.value_or(viewer.message()));
  std::string file = path;
  if (lowerExtension(path) != ".png") {
    if (count >= 0) viewer.saved = count;
    const std::string number = std::to_string(viewer.saved++);
    file += std::string(number.size() < 6 ? 6 - number.size() : 0, '0') + number + ".png";
  }
  nb::module_::import_("kinegraph.png").attr("writePng")(file, rgbOf(image));
  return file;
}

void bindPictures(nb::class_<PyViewer>& viewer) {
  viewer
      .def(
          "getRgb",
          [](PyViewer& v, bool) {
            CameraImage image = picture(v, v.message());
            return rgbOf(image);
          },
          "nonThreaded"_a = true, docs::pictures::getRgb)
      .def(
          "getDepth",
          [](PyViewer& v, bool) {
            CameraImage image = picture(v, v.message(), true);
            return depthOf(image);
          },
          "nonThreaded"_a = true, docs::pictures::getDepth)
      .def(
          "savePng", [](PyViewer& v, const std::string& path, int count) { return savePicture(v, path, count); },
          "saveVideoPath"_a = "z.vid/", "count"_a = -1, docs::pictures::savePng)
      .def("setCamera", setViewCamera, "camFrame"_a.none() = nb::none(), docs::pictures::setCamera)
      .def("setCamera", setCameraTarget, "position"_a, "target"_a, docs::pictures::setCameraAt)
      .def(
          "setCameraPose",
          [](PyViewer& v, const Numbers& pose) {
            Camera camera = cameraNow(v);
            camera.pose = Pose::fromNumbers(pose.values);
            placeCamera(v, camera);
          },
          "pose_7d"_a, docs::pictures::setCameraPose)
      .def(
          "getCamera_pose", [](PyViewer& v) { return toNumpy(VectorXd(cameraNow(v).pose.numbers())); },
          "The camera's pose, shape (7,): x y z (m) qw qx qy qz.")
      .def(
          "getCamera_fxycxy", [](PyViewer& v) { return fxycxyOf(cameraNow(v)); },
          "fx, fy, cx, cy in pixels, shape (4,).")
      .def(
          "getCamera_focalLength",
          [](PyViewer& v) {
            const double f = cameraNow(v).focal_length;
            return toNumpy(VectorXd(Vector4d(f, f, 0., 0.)));
          },
          "The focal length in image heights, twice, and two zeros, shape (4,).")
      .def("focus", focus, "position_3d"_a, "heightAbs"_a = 1., docs::pictures::focus)
      .def("fit", fit, docs::pictures::fit)
      .def(
          "setWindow",
          [](PyViewer& v, const std::string& title, int width, int height) {
            Camera camera = cameraNow(v);
            camera.width = width;
            camera.height = height;
            camera.validate();
            v.camera.resize(width, height);
            v.setTitle(title);
          },
          "title"_a, "width"_a, "height"_a, docs::pictures::setWindow)
      .def(
          "visualsOnly",
          [](PyViewer& v, bool yes) {
            v.visuals_only = yes;
            if (v.isOpen()) openPage(v);
          },
          "_visualsOnly"_a = true, docs::pictures::visualsOnly);
}

}  // namespace kinegraph::python
