#include <nanobind/ndarray.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "defaults.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/rendering/camera_renderer.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "rendering/images.h"
#include "rendering/rendering_docs.h"
#include "simulation/depth_noise.h"
#include "viewer/py_viewer.h"

namespace kinegraph::python {

DepthNoise depthNoise() {
  const nb::object set = nb::module_::import_("kinegraph.compatibility.parameters").attr("params_get")();
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

namespace {

constexpr int kNoFrame = 0xffffff;  // in segmentation images

/// The Python object of a CameraView: the cameras of one configuration.
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

nb::typed<nb::tuple, ByteArray, FloatArray> computeImageAndDepth(PyCameraView& view, nb::handle config, bool noisy,
                                                                 bool visuals_only) {
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

IdArray segmentationIds(PyCameraView& view, bool visuals_only) {
  const Camera camera = view.camera.now();
  return toImage<IdArray>(segment(view, camera, visuals_only), {std::size_t(camera.height), std::size_t(camera.width)});
}

/// Encodes ids as colors. The lowest six bits of an id give the two top bits of r, g and b, so that close ids look
/// different; the next 18 bits give the rest.
ByteArray segmentationImage(PyCameraView& view, bool visuals_only) {
  const Camera camera = view.camera.now();
  std::vector<std::uint8_t> colors;
  for (const std::int32_t frame : segment(view, camera, visuals_only)) {
    const int id = frame < 0 ? kNoFrame : frame;
    for (int channel = 0; channel < 3; ++channel) {
      const int top = (id >> channel & 1) << 7 | (id >> (channel + 3) & 1) << 6;
      colors.push_back(std::uint8_t(top | (id >> (6 + 6 * channel) & 63)));
    }
  }
  return toImage<ByteArray>(std::move(colors), {std::size_t(camera.height), std::size_t(camera.width), 3});
}

using DepthArray = nb::ndarray<const float, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

Array depthImage2PointCloud(const DepthArray& depth, const Numbers& fxycxy) {
  if (fxycxy.values.size() != 4)
    throw ValueError(cat("depthImage2PointCloud: fxycxy has ", fxycxy.values.size(), " entries; expected 4"));
  const std::size_t height = depth.shape(0), width = depth.shape(1);
  return toImage<Array>(depthToPoints(depth.data(), int(height), int(width), Vector4d(fxycxy.values)),
                        {height, width, 3});
}

}  // namespace

void bindRendering(nb::module_& m) {
  nb::class_<Camera>(m, "CameraViewSensor", "A camera of CameraView.setCamera.")
      .def_ro("width", &Camera::width, "Width of the image in pixels.")
      .def_ro("height", &Camera::height, "Height of the image in pixels.")
      .def_ro("focalLength", &Camera::focal_length, "Focal length in image heights.")
      .def_prop_ro(
          "zRange", [](const Camera& c) { return std::pair(c.near, c.far); }, "Nearest and farthest visible depth, m.")
      .def_prop_ro(
          "pose", [](const Camera& c) { return toNumpy(VectorXd(c.pose.numbers())); },
          "World pose when the camera was set, shape (7,): x y z (m) qw qx qy qz.");

  nb::class_<PyCameraView>(
      m, "CameraView",
      "Renders images from cameras in a configuration, without display or browser. A camera looks along the z\n"
      "axis of its frame, x to the right and y down.")
      .def(
          "__init__",
          [](PyCameraView* self, nb::object config, bool, int) {
            if (!nb::isinstance<PyConfig>(config)) throw nb::next_overload();
            new (self) PyCameraView{std::move(config)};
          },
          "config"_a, "offscreen"_a = true, "verbose"_a = 0, docs::rendering::make)
      .def(
          "setCamera",
          [](PyCameraView& v, const FrameArgument& frame) {
            const Frame given = toFrame(nb::cast<PyConfig&>(v.config), frame, "setCamera");
            v.camera.follow(given.scene(), given.data());
            return v.camera.now();
          },
          "cameraFrameName"_a, docs::rendering::setCamera)
      .def(
          "getFxycxy", [](PyCameraView& v) { return fxycxyOf(v.camera.now()); },
          "fx, fy, cx, cy in pixels, shape (4,).")
      .def("computeImageAndDepth", computeImageAndDepth, "config"_a.none() = nb::none(), "simulateDepthNoise"_a = false,
           "visualsOnly"_a = true, docs::rendering::computeImageAndDepth)
      .def("computeSegmentationID", segmentationIds, "visualsOnly"_a = true, docs::rendering::computeSegmentationID)
      .def("computeSegmentationImage", segmentationImage, "visualsOnly"_a = true,
           docs::rendering::computeSegmentationImage);

  m.def("depthImage2PointCloud", depthImage2PointCloud, "depth"_a, "fxycxy"_a, docs::rendering::depthImage2PointCloud);
}

}  // namespace kinegraph::python
