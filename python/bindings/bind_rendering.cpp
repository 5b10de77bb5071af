#include <nanobind/ndarray.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "defaults.h"
#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/rendering/depth_image.h"
#include "py_viewer.h"

namespace kinegraph::python {

namespace {

constexpr int kNoFrame = 0xffffff;  // in segmentation images

/// An array of whatever numbers an image is made of.
using AnyArray = nb::typed<nb::object, nb::any>;

/// A numpy array that owns these values.
template <class T>
AnyArray toImage(std::vector<T> values, std::initializer_list<std::size_t> shape) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  T* data = kept->data();
  const nb::capsule owner(kept.release(), [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return nb::cast(nb::ndarray<nb::numpy, T>(data, shape, owner));
}

AnyArray rgbOf(CameraImage& image) {
  return toImage(std::move(image.rgb), {std::size_t(image.height), std::size_t(image.width), 3});
}

AnyArray depthOf(CameraImage& image) {
  return toImage(std::move(image.depth), {std::size_t(image.height), std::size_t(image.width)});
}

Array fxycxyOf(const Camera& camera) { return toNumpy(VectorXd(camera.fxycxy())); }

/// What Python calls a CameraView: the cameras of one configuration.
struct PyCameraView {
  nb::object config;
  ViewCamera camera{[] {
    Camera start = defaultViewCamera();
    start.width = 640;
    start.height = 480;
    return start;
  }()};
  CameraRenderer renderer{};
};

SceneTree& sceneOf(const PyCameraView& view, nb::handle config) {
  return *nb::cast<PyConfig&>(config.is_none() ? nb::handle(view.config) : config).scene();
}

DepthNoise depthNoise() {
  const nb::object set = nb::module_::import_("kinegraph.parameters").attr("params_get")();
  DepthNoise noise;
  const auto read = [&](double& value, const char* name) {
    value = nb::cast<double>(set.attr("get")(cat("DepthNoise/", name).c_str(), value));
  };
  read(noise.baseline, "binocular_baseline");
  read(noise.overall, "noise_all");
  read(noise.wide, "noise_wide");
  read(noise.local, "noise_local");
  read(noise.pixel, "noise_pixel");
  noise.validate();
  return noise;
}

nb::typed<nb::tuple, nb::any, nb::any> computeImageAndDepth(PyCameraView& view, nb::handle config, bool noisy, bool visuals_only) {
  SceneTree& scene = sceneOf(view, config);
  const Camera camera = view.camera.now();
  const DepthNoise noise = noisy ? depthNoise() : DepthNoise{};
  CameraImage image, other;
  {
    const nb::gil_scoped_release unlock;
    image = view.renderer.render(scene, camera, visuals_only);
    if (noisy) other = view.renderer.render(scene, otherEye(camera, noise), visuals_only);
  }
  if (noisy) addDepthNoise(image.depth, other.depth, camera, noise, defaults().random);
  return nb::make_tuple(rgbOf(image), depthOf(image));
}

std::vector<std::int32_t> segment(PyCameraView& view, const Camera& camera, bool visuals_only) {
  SceneTree& scene = sceneOf(view, nb::none());
  const nb::gil_scoped_release unlock;
  return view.renderer.segment(scene, camera, visuals_only);
}

AnyArray segmentationIds(PyCameraView& view, bool visuals_only) {
  const Camera camera = view.camera.now();
  return toImage(segment(view, camera, visuals_only), {std::size_t(camera.height), std::size_t(camera.width)});
}

/// The first six bits of an id give the two top bits of r, g and b, so that near ids look different; the next 18 the rest.
AnyArray segmentationImage(PyCameraView& view, bool visuals_only) {
  const Camera camera = view.camera.now();
  std::vector<std::uint8_t> colors;
  for (const std::int32_t frame : segment(view, camera, visuals_only)) {
    const int id = frame < 0 ? kNoFrame : frame;
    for (int channel = 0; channel < 3; ++channel) {
      const int top = (id >> channel & 1) << 7 | (id >> (channel + 3) & 1) << 6;
      colors.push_back(std::uint8_t(top | (id >> (6 + 6 * channel) & 63)));
    }
  }
  return toImage(std::move(colors), {std::size_t(camera.height), std::size_t(camera.width), 3});
}

using DepthArray = nb::ndarray<const float, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

AnyArray depthImage2PointCloud(const DepthArray& depth, const Numbers& fxycxy) {
  if (fxycxy.values.size() != 4) throw ValueError(cat("depthImage2PointCloud: fxycxy has ", fxycxy.values.size(), " numbers; expected 4"));
  const std::size_t height = depth.shape(0), width = depth.shape(1);
  return toImage(depthToPoints(depth.data(), int(height), int(width), Vector4d(fxycxy.values)), {height, width, 3});
}

/// What `params_add` says of pictures and pages, as the reference calls it.
struct RenderParameters {
  std::optional<Vector3d> background, floor;
  bool has_floor = true;
  bool shadows = true;
  bool text = true;
};

RenderParameters renderParameters() {
  const nb::object set = nb::module_::import_("kinegraph.parameters").attr("params_get")();
  const auto numbers = [&](const char* name) {
    const nb::object value = set.attr("get")(name, nb::list());
    return nb::cast<std::vector<double>>(value);
  };
  const auto flag = [&](const char* name) { return nb::cast<bool>(nb::bool_(set.attr("get")(name, true))); };
  RenderParameters given;
  const std::vector<double> background = numbers("Render/backgroundColor"), floor = numbers("Render/floorColor");
  if (background.size() == 3) given.background = Vector3d(background.data());
  if (floor.size() == 3) given.floor = Vector3d(floor.data());
  given.has_floor = floor.empty() || floor.size() == 3;
  given.shadows = flag("Render/renderShadow");
  given.text = flag("Render/renderText");
  return given;
}

/// Where a viewer looks from; at first that is a frame `camera_init`, if there is one.
Camera cameraNow(PyViewer& viewer) {
  if (!viewer.camera_is_set && viewer.scene) {
    if (FrameData* frame = viewer.scene->find("camera_init")) viewer.camera.follow(Frame(viewer.scene, *frame));
    viewer.camera_is_set = true;
  }
  return viewer.camera.now();
}

/// A picture of what the viewer shows.
CameraImage picture(PyViewer& viewer) {
  if (!viewer.scene) throw ValueError("this viewer shows nothing yet; call view() first");
  const Camera camera = cameraNow(viewer);
  if (!viewer.renderer) {
    const RenderParameters given = renderParameters();
    RendererOptions options{.supersampling = 2, .shadows = given.shadows, .floor = given.has_floor};
    if (given.background) options.background = *given.background;
    if (given.floor) options.floor_color = *given.floor;
    viewer.renderer.emplace(options);
  }
  const nb::gil_scoped_release unlock;
  return viewer.renderer->render(*viewer.scene, camera, viewer.visuals_only);
}

/// What the page turns about: a point in front of the camera that is about as far away as the scene.
void aim(PyViewer& viewer, const Camera& camera) {
  viewer.setCamera(camera.pose.p, camera.pose.p + camera.pose.q * Vector3d(0., 0., 2.), camera.focal_length);
}

/// Turns the camera to a point, and moves it to where `height` m fit into the picture there.
void focus(PyViewer& viewer, const Numbers& at, double height) {
  if (at.values.size() != 3) throw ValueError(cat("focus: the position has ", at.values.size(), " numbers; expected 3"));
  if (!(height > 0. && std::isfinite(height))) throw ValueError(cat("focus: heightAbs is ", height, "; expected m, more than 0"));
  Camera camera = cameraNow(viewer);
  const Vector3d point(at.values), back = camera.pose.p - point;
  if (back.norm() < 1e-9) throw ValueError("focus: the camera is at that position");
  camera.pose = lookAt(point + height * camera.focal_length * back.normalized(), point);
  viewer.camera.place(camera);
  viewer.camera_is_set = true;
  if (viewer.isOpen()) viewer.setCamera(camera.pose.p, point, camera.focal_length);
}

/// The page in the browser looks from there as well, if there is one.
void placeCamera(PyViewer& viewer, const Camera& camera) {
  viewer.camera.place(camera);
  viewer.camera_is_set = true;
  if (viewer.isOpen()) aim(viewer, camera);
}

void setViewCamera(PyViewer& viewer, nb::handle frame) {
  if (frame.is_none()) return placeCamera(viewer, defaultViewCamera());
  std::optional<Frame> given;
  if (nb::isinstance<Frame>(frame)) given = nb::cast<Frame>(frame);
  else if (viewer.scene) given = Frame(viewer.scene, viewer.scene->get(nb::cast<std::string>(frame), "setCamera"));
  else throw ValueError("this viewer shows nothing yet; give the frame itself, or call view() first");
  placeCamera(viewer, cameraOf(*given));
  viewer.camera.follow(*given);
}

}  // namespace

void preparePage(PyViewer& viewer) {
  const RenderParameters given = renderParameters();
  viewer.look.background = given.background;
  viewer.look.floor = given.floor;
  viewer.look.has_floor = given.has_floor;
  viewer.look.shadows = given.shadows;
  viewer.look.text = given.text;
  viewer.server().setLook(viewer.look);
  FrameData* tracked = viewer.scene->find("camera_track");
  if (tracked) {
    viewer.camera.follow(Frame(viewer.scene, *tracked));
    viewer.camera_is_set = true;
    aim(viewer, viewer.camera.now());
  } else if (!viewer.camera_is_set && viewer.scene->find("camera_init")) {
    aim(viewer, cameraNow(viewer));
  }
}

std::string savePicture(PyViewer& viewer, const std::string& path, int count) {
  CameraImage image = picture(viewer);
  std::string file = path;
  if (!path.ends_with(".png")) {
    if (count >= 0) viewer.saved = count;
    const std::string number = std::to_string(viewer.saved++);
    file += std::string(number.size() < 6 ? 6 - number.size() : 0, '0') + number + ".png";
  }
  nb::module_::import_("kinegraph.png").attr("writePng")(file, rgbOf(image));
  return file;
}

void bindPictures(nb::class_<PyViewer>& viewer) {
  viewer
      .def("getRgb", [](PyViewer& v, bool) { CameraImage image = picture(v); return rgbOf(image); }, "nonThreaded"_a = true,
           "A picture of the scene, drawn without a browser: uint8 (height, width, 3).")
      .def("getDepth", [](PyViewer& v, bool) { CameraImage image = picture(v); return depthOf(image); }, "nonThreaded"_a = true,
           "Its depth along the camera's z axis: float32 (height, width), m; -1 where nothing is.")
      .def("savePng", savePicture, "saveVideoPath"_a = "z.vid/", "count"_a = -1,
           "Saves a picture, and returns the file's name: `saveVideoPath` itself if it ends in .png; else it is a prefix that\n"
           "gets a number of six digits, which counts up from 0, or from `count`. Folders are made.")
      .def("setCamera", setViewCamera, "frame"_a.none() = nb::none(),
           "Looks from a camera frame (or its name) and follows it, as CameraView.setCamera; None: from where viewers start.")
      .def("setCamera",
           [](PyViewer& v, const Numbers& position, const Numbers& target) {
             if (position.values.size() != 3 || target.values.size() != 3) throw ValueError("setCamera: position and target are 3 numbers each");
             Camera camera = cameraNow(v);
             camera.pose = lookAt(Vector3d(position.values), Vector3d(target.values));
             v.camera.place(camera);
             v.camera_is_set = true;
             v.setCamera(Vector3d(position.values), Vector3d(target.values));
           }, "position"_a, "target"_a, "Where to look from, and at: 3 numbers each, m. Starts the viewer if it does not run.")
      .def("setCameraPose",
           [](PyViewer& v, const Numbers& pose) {
             Camera camera = cameraNow(v);
             camera.pose = Pose::fromNumbers(pose.values);
             placeCamera(v, camera);
           }, "pose7"_a, "Where the camera is, (7,): x to the right of the image, y down, z forward.")
      .def("getCamera_pose", [](PyViewer& v) { return toNumpy(VectorXd(cameraNow(v).pose.numbers())); }, "The camera's pose, (7,).")
      .def("getCamera_fxycxy", [](PyViewer& v) { return fxycxyOf(cameraNow(v)); }, "fx, fy, cx, cy in pixels.")
      .def("getCamera_focalLength",
           [](PyViewer& v) {
             const double f = cameraNow(v).focal_length;
             return toNumpy(VectorXd(Vector4d(f, f, 0., 0.)));
           }, "Focal length in image heights, twice, and two zeros.")
      .def("focus", focus, "position"_a, "heightAbs"_a = 1.,
           "Turns the camera to a point, and moves it so far away that heightAbs m fit into the height of the window.")
      .def("setWindow",
           [](PyViewer& v, const std::string& title, int width, int height) {
             Camera camera = cameraNow(v);
             camera.width = width;
             camera.height = height;
             camera.validate();
             v.camera.resize(width, height);
             if (v.isOpen()) v.setTitle(title);
           }, "title"_a, "width"_a, "height"_a, "Title of the page, and the size of pictures in pixels.")
      .def("visualsOnly", [](PyViewer& v, bool yes) {
             v.visuals_only = yes;
             v.look.visuals_only = yes;
             if (v.isOpen()) v.server().setLook(v.look);
           }, "_visualsOnly"_a = true,
           "Hides markers, transparent shapes and texts, on the page and in pictures; False shows them again.");
}

void bindRendering(nb::module_& m) {
  nb::class_<Camera>(m, "CameraViewSensor", "A camera as CameraView.setCamera found it.")
      .def_ro("width", &Camera::width, "Pixels.")
      .def_ro("height", &Camera::height, "Pixels.")
      .def_ro("focalLength", &Camera::focal_length, "In image heights.")
      .def_prop_ro("zRange", [](const Camera& c) { return nb::make_tuple(c.near, c.far); }, "Nearest and farthest depth, m.")
      .def_prop_ro("pose", [](const Camera& c) { return toNumpy(VectorXd(c.pose.numbers())); }, "(7,), when it was set.");

  nb::class_<PyCameraView>(m, "CameraView",
                           "Images from cameras in a configuration; they need neither display nor browser. A camera looks along the z\n"
                           "axis of its frame, x to the right and y down.")
      .def("__init__", [](PyCameraView* self, nb::object config, bool, int) {
             if (!nb::isinstance<PyConfig>(config)) throw nb::type_error("CameraView: expected a Config");
             new (self) PyCameraView{std::move(config)};
           }, "config"_a, "offscreen"_a = true, "verbose"_a = 0, "Sees the configuration as it is whenever an image is computed.")
      .def("setCamera",
           [](PyCameraView& v, nb::handle frame) {
             v.camera.follow(toFrame(nb::cast<PyConfig&>(v.config), frame));
             return v.camera.now();
           }, "cameraFrame"_a,
           "Looks from a frame, or a frame's name, and follows it. Its attributes: `width`, `height` (pixels; 640, 480),\n"
           "`focalLength` (in image heights; 2.414) or `heightAngle` (degrees), `orthoAbsHeight` (m, for an orthographic camera),\n"
           "`zRange` ([nearest, farthest] depth in m; [.1, 10]).")
      .def("getFxycxy", [](const PyCameraView& v) { return fxycxyOf(v.camera.now()); }, "fx, fy, cx, cy in pixels.")
      .def("computeImageAndDepth", computeImageAndDepth, "config"_a.none() = nb::none(), "simulateDepthNoise"_a = false, "visualsOnly"_a = true,
           "The image, uint8 (height, width, 3), and the depth along the camera's z axis, float32 (height, width), in m; -1 where\n"
           "nothing is within zRange. config: another configuration to look at.\n"
           "simulateDepthNoise: errors of a stereo camera (parameters DepthNoise/...).\n"
           "visualsOnly: without markers and transparent shapes; these show in the image, but transparent ones not in the depth.")
      .def("computeSegmentationID", segmentationIds, "visualsOnly"_a = true,
           "The id of the frame that each pixel shows, int32 (height, width); -1 for the floor and where nothing is.")
      .def("computeSegmentationImage", segmentationImage, "visualsOnly"_a = true,
           "The ids as colours, uint8 (height, width, 3); white for the floor and where nothing is.");

  m.def("depthImage2PointCloud", depthImage2PointCloud, "depth"_a, "fxycxy"_a,
        "Points (height, width, 3) of a depth image in the camera's frame, m; zeros where the depth is negative.\n"
        "depth: (height, width), m. fxycxy: fx, fy, cx, cy in pixels, as getFxycxy() gives them.");
}

}  // namespace kinegraph::python
