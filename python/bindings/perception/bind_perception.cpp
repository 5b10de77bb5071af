#include <nanobind/ndarray.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/perception/register_scene.h"
#include "perception/perception_docs.h"
#include "python_names.h"

namespace kinegraph::python {

namespace {

using DepthInMeters = nb::ndarray<const float, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

/// float32 depths in m from an array of any number type.
DepthInMeters inMeters(nb::handle given, std::optional<double> unit) {
  const nb::module_ np = nb::module_::import_("numpy");
  nb::object depth = np.attr("asarray")(given);
  const std::string kind = nb::cast<std::string>(depth.attr("dtype").attr("kind"));
  if (kind != "f" && kind != "i" && kind != "u")
    throw ValueError(cat("DepthView: depth has numbers of type ",
                         nb::cast<std::string>(depth.attr("dtype").attr("name")), "; expected floats or integers"));
  if (nb::cast<int>(depth.attr("ndim")) != 2)
    throw ValueError(
        cat("DepthView: depth has ", nb::cast<int>(depth.attr("ndim")), " dimensions; expected shape (height, width)"));
  const double scale = unit.value_or(kind == "f" ? 1. : .001);
  if (!(scale > 0.)) throw ValueError(cat("DepthView: unit is ", scale, "; expected m per unit, more than 0"));
  if (scale != 1.) depth = depth.attr("astype")("float32").attr("__mul__")(np.attr("float32")(scale));
  return nb::cast<DepthInMeters>(np.attr("ascontiguousarray")(depth, "float32"));
}

void makeDepthView(DepthView* self, const ArrayArgument& depth, const Numbers& fxycxy, nb::handle camera,
                   std::optional<double> unit, double noise, double bias) {
  const DepthInMeters meters = inMeters(depth, unit);
  DepthView view;
  view.height = int(meters.shape(0));
  view.width = int(meters.shape(1));
  view.depth.assign(meters.data(), meters.data() + meters.size());
  if (fxycxy.values.size() != 4)
    throw ValueError(cat("DepthView: fxycxy has ", fxycxy.values.size(), " entries; expected 4: fx fy cx cy"));
  view.fxycxy = fxycxy.values;
  if (nb::isinstance<nb::str>(camera)) {
    view.camera = nb::cast<std::string>(camera);
  } else {
    Numbers pose;
    if (!readNumbers(camera, pose) || pose.values.size() != 7)
      throw ValueError(
          "DepthView: camera is neither the name of a frame nor a pose; expected 7 numbers x y z qw qx qy "
          "qz");
    view.pose = Pose::fromNumbers(pose.values);
  }
  view.noise = noise;
  view.bias = bias;
  view.validate("DepthView");
  new (self) DepthView(std::move(view));
}

Array seenPose(const Pose& pose) { return toNumpy(VectorXd(pose.numbers())); }

SeenScene registerFrames(PyConfig& config, nb::handle views, const std::vector<std::string>& frames,
                         const std::optional<std::string>& support, double search_radius) {
  std::vector<DepthView> given;
  if (nb::isinstance<DepthView>(views)) {
    given.push_back(nb::cast<DepthView>(views));
  } else {
    given = nb::cast<std::vector<DepthView>>(views);
  }
  RegisterOptions options;
  options.support = support.value_or("");
  options.search_radius = search_radius;
  SeenScene seen;
  {
    const nb::gil_scoped_release unlock;
    seen = registerScene(config, given, frames, options);
  }
  for (const std::string& warning : seen.warnings) emitWarning(cat("registerScene: ", inPython(warning)));
  return seen;
}

const SeenFrame& seenFrameOf(const SeenScene& seen, const std::string& name) {
  const auto found = seen.frames.find(name);
  if (found != seen.frames.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : seen.frames) names.push_back(entry.first);
  throw FrameNotFound(cat("SeenScene: frame '", name, "' was not looked for; looked for: ", join(names)));
}

void bindSeenFrame(nb::module_& m) {
  nb::enum_<SeenStatus>(m, "SeenStatus", "Whether registerScene saw a frame.")
      .value("seen", SeenStatus::seen, "The pose is measured, and the frame was moved to it.")
      .value("occluded", SeenStatus::occluded, "Something is in front of it; `by` names it.")
      .value("not_in_view", SeenStatus::not_in_view, "It is outside of all images, or nothing was measured.")
      .value("not_there", SeenStatus::not_there, "The cameras looked through its place.");
  nb::class_<SeenFrame>(m, "SeenFrame", "How registerScene saw a frame.")
      .def_ro("status", &SeenFrame::status, "A SeenStatus: whether it was seen, or why not.")
      .def_prop_ro(
          "pose", [](const SeenFrame& f) { return seenPose(f.pose); },
          "Pose in the world, shape (7,): x y z (m) qw qx qy qz; the last one unless it was seen.")
      .def_prop_ro(
          "covariance", [](const SeenFrame& f) { return toNumpy(f.covariance); },
          "Covariance of (x y z in m, rotation vector in rad) in world axes, shape (6, 6); (0, 0) unless seen.")
      .def_prop_ro(
          "free_directions", [](const SeenFrame& f) { return toNumpy(f.free_directions); },
          "Unit displacements that the images do not determine, shape (n, 6), as in covariance: rotations about the\n"
          "axis of a symmetric shape, or of a mug with a hidden handle.")
      .def_prop_ro(
          "alternatives",
          [](const SeenFrame& f) {
            std::vector<Array> poses;
            for (const Pose& pose : f.alternatives) poses.push_back(seenPose(pose));
            return poses;
          },
          "Other poses that explain the images about as well, each of shape (7,).")
      .def_ro("visible", &SeenFrame::visible,
              "The share of the surface, seen if the thing were alone, that the cameras measured, 0..1.")
      .def_ro("score", &SeenFrame::score,
              "1: all measurements at its surface agree with it; -1.5: the cameras looked through all of it.")
      .def_ro("by", &SeenFrame::by, "If occluded, the name of the frame in front; \"\" for something unknown.")
      .def("__repr__", [](const SeenFrame& f) { return cat("<SeenFrame ", f.str(), ">"); });
}

}  // namespace

void bindPerception(nb::module_& m) {
  nb::class_<DepthView>(m, "DepthView", "A depth image with the camera that took it.")
      .def("__init__", makeDepthView, "depth"_a, "fxycxy"_a, "camera"_a, nb::kw_only(), "unit"_a = nb::none(),
           "noise"_a = .0027, "bias"_a = .0019, docs::perception::makeView)
      .def_ro("width", &DepthView::width, "Width of the image in pixels.")
      .def_ro("height", &DepthView::height, "Height of the image in pixels.")
      .def_prop_ro(
          "fxycxy", [](const DepthView& v) { return toNumpy(VectorXd(v.fxycxy)); },
          "fx, fy, cx, cy in pixels, shape (4,).");
  bindSeenFrame(m);
  nb::class_<SeenScene>(m, "SeenScene", "The frames that registerScene looked for: seen[\"cup\"].pose.")
      .def("__getitem__", seenFrameOf, nb::rv_policy::reference_internal, "name"_a, "Returns the SeenFrame of a name.")
      .def("__len__", [](const SeenScene& s) { return s.frames.size(); })
      .def_ro("frames", &SeenScene::frames, "The SeenFrame of each name.")
      .def(
          "poses",
          [](const SeenScene& s) {
            std::map<std::string, std::optional<Array>> poses;
            for (const auto& [name, frame] : s.frames) {
              poses[name] = std::nullopt;
              if (frame.status == SeenStatus::seen) poses[name] = seenPose(frame.pose);
            }
            return poses;
          },
          "Returns the poses, shape (7,), of the frames that were seen, and None for the others; execute(observe=...)\n"
          "takes them.")
      .def_ro("warnings", &SeenScene::warnings, "Sentences about views without depth, doubtful cameras and overlaps.")
      .def("__repr__", [](const SeenScene& s) { return cat("<SeenScene\n", inPython(s.str()), ">"); });
  m.def("registerScene", registerFrames, "config"_a, "views"_a, "frames"_a, nb::kw_only(), "support"_a = nb::none(),
        "search_radius"_a = RegisterOptions().search_radius,
        nb::sig("def registerScene(config: Config, views: DepthView | collections.abc.Sequence[DepthView], frames: "
                "collections.abc.Sequence[str], *, support: str | None = None, search_radius: float = 0.05) -> "
                "SeenScene"),
        docs::perception::registerScene);
}

}  // namespace kinegraph::python
