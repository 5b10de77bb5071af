#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/rendering/camera_renderer.h"
#include "rendering/images.h"
#include "viewer/pictures_docs.h"
#include "viewer/py_viewer.h"

namespace kinegraph::python {

namespace {

/// Renders the viewer's scene, with a text on it.
CameraImage picture(PyViewer& viewer, const std::string& text, bool has_depth = false) {
  takeAppearance(viewer);
  ViewerPictures& pictures = viewer.pictures();
  PictureContent content = pictures.content(has_depth);
  content.scene = Config(*content.scene).scene();  // other threads may change the scene meanwhile
  const nb::gil_scoped_release unlock;
  return pictures.draw(content, text);
}

Vector3d point(const Numbers& numbers, const char* what) {
  if (numbers.values.size() != 3) throw ValueError(cat(what, " has ", numbers.values.size(), " entries; expected 3"));
  return Vector3d(numbers.values);
}

void setViewCamera(PyViewer& viewer, nb::handle frame) {
  if (frame.is_none()) return viewer.setCamera(defaultViewCamera());
  if (nb::isinstance<Frame>(frame)) return viewer.setCamera(nb::cast<Frame>(frame));
  if (!viewer.scene)
    throw ValueError("this viewer has no scene yet; pass a Frame instead of its name, or call view() first");
  viewer.setCamera(Frame(viewer.scene, viewer.scene->get(nb::cast<std::string>(frame), "setCamera")));
}

}  // namespace

std::string savePicture(PyViewer& viewer, const std::string& path, int count, const std::optional<std::string>& text) {
  CameraImage image = picture(viewer, text.value_or(viewer.message()));
  const std::string file = viewer.pictures().fileOf(path, count);
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
      .def(
          "setCamera",
          [](PyViewer& v, const Numbers& position, const Numbers& target) {
            v.setCamera(point(position, "setCamera: position"), point(target, "setCamera: target"));
          },
          "position"_a, "target"_a, docs::pictures::setCameraAt)
      .def(
          "setCameraPose",
          [](PyViewer& v, const Numbers& pose) {
            Camera camera = v.camera();
            camera.pose = Pose::fromNumbers(pose.values);
            v.setCamera(camera);
          },
          "pose_7d"_a, docs::pictures::setCameraPose)
      .def(
          "getCamera_pose", [](PyViewer& v) { return toNumpy(VectorXd(v.camera().pose.numbers())); },
          "The camera's pose, shape (7,): x y z (m) qw qx qy qz.")
      .def(
          "getCamera_fxycxy", [](PyViewer& v) { return fxycxyOf(v.camera()); }, "fx, fy, cx, cy in pixels, shape (4,).")
      .def(
          "getCamera_focalLength",
          [](PyViewer& v) {
            const double f = v.camera().focal_length;
            return toNumpy(VectorXd(Vector4d(f, f, 0., 0.)));
          },
          "The focal length in image heights, twice, and two zeros, shape (4,).")
      .def(
          "focus",
          [](PyViewer& v, const Numbers& at, double height) { v.focus(point(at, "focus: position_3d"), height); },
          "position_3d"_a, "heightAbs"_a = 1., docs::pictures::focus)
      .def(
          "fit", [](PyViewer& v) { return toNumpy(VectorXd(v.fit())); }, docs::pictures::fit)
      .def("setWindow", &PyViewer::setWindow, "title"_a, "width"_a, "height"_a, docs::pictures::setWindow)
      .def(
          "visualsOnly", [](PyViewer& v, bool yes) { v.visualsOnly(yes); }, "_visualsOnly"_a = true,
          docs::pictures::visualsOnly);
}

}  // namespace kinegraph::python
