#include <nanobind/ndarray.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstring>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/api/next_view.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/perception/calibrate_camera.h"
#include "kinegraph/perception/measured_depth.h"
#include "kinegraph/perception/occupancy_map.h"
#include "kinegraph/perception/register_scene.h"
#include "kinegraph/scene/collisions.h"
#include "perception/calibration_docs.h"
#include "perception/depth_views.h"
#include "perception/perception_docs.h"
#include "perception/seen_pickle.h"
#include "planning/plan_objects.h"
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
  if (kind != "f") {  // the largest number of its type is no measurement
    const nb::object none = depth.attr("__eq__")(np.attr("iinfo")(depth.attr("dtype")).attr("max"));
    depth = np.attr("where")(none, np.attr("zeros")(1, depth.attr("dtype")), depth);
  }
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

SeenScene registerFrames(PyConfig& config, nb::handle views, const std::vector<std::string>& frames,
                         const std::optional<std::string>& support, double search_radius, const std::string& prior,
                         const std::vector<std::string>& estimate) {
  const std::vector<DepthView> given = depthViews(views);
  RegisterOptions options;
  for (const std::string& name : estimate) options.estimate.push_back(estimateFromName(name));
  options.prior = priorFromName(prior);
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
      .value("not_there", SeenStatus::not_there, "The cameras looked through its place.")
      .value("not_found", SeenStatus::not_found,
             "It is nowhere in the images, or too little of it: only with prior=\"anywhere\".");
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
      .def_ro("may_be", &SeenFrame::may_be,
              "Names of frames that look alike and may be the one seen here, while this one is at their place or not\n"
              "seen. Nothing but the distances from the last poses tells them apart.")
      .def_ro("by", &SeenFrame::by, "If occluded, the name of the frame in front; \"\" for something unknown.")
      .def("__repr__", [](const SeenFrame& f) { return cat("<SeenFrame ", f.str(), ">"); });
}

using Bytes = nb::ndarray<nb::numpy, std::uint8_t>;

void makeMap(OccupancyMap* self, const PyConfig& config, const Numbers& region, double cell,
             const std::vector<std::string>& free) {
  if (region.values.size() != 6)
    throw ValueError(
        cat("OccupancyMap: region has ", region.values.size(), " numbers; expected two corners, shape (2, 3), in m"));
  new (self) OccupancyMap(config, region.values.head(3), region.values.tail(3), cell, free);
}

std::vector<std::string> updateMap(OccupancyMap& map, const PyConfig& config, nb::handle views,
                                   const std::optional<SeenScene>& known) {
  const std::vector<DepthView> given = depthViews(views);
  std::vector<std::string> warnings;
  {
    const nb::gil_scoped_release unlock;
    warnings = map.update(config, given, known.value_or(SeenScene{}));
  }
  for (const std::string& warning : warnings) emitWarning(cat("OccupancyMap.update: ", inPython(warning)));
  return warnings;
}

ByteArray statesOf(const OccupancyMap& map) {
  const std::vector<CellState>& states = map.states();
  auto* copy = new std::uint8_t[states.size()];
  std::memcpy(copy, states.data(), states.size());
  const nb::capsule owner(copy, [](void* p) noexcept { delete[] static_cast<std::uint8_t*>(p); });
  const auto& count = map.counts();
  return ByteArray(nb::cast(Bytes(copy, {std::size_t(count[0]), std::size_t(count[1]), std::size_t(count[2])}, owner)));
}

std::vector<CellState> stateAt(const OccupancyMap& map, const Numbers& points) {
  if (points.values.size() % 3 != 0)
    throw ValueError(
        cat("OccupancyMap.state: ", points.values.size(), " numbers; expected points, shape (3,) or (n, 3)"));
  std::vector<CellState> states;
  for (Eigen::Index i = 0; i + 2 < points.values.size(); i += 3)
    states.push_back(map.state(points.values.segment(i, 3)));
  return states;
}

CameraCalibration calibrate(PyConfig& config, const std::string& camera, const std::string& marker,
                            const Numbers& points, const Numbers& fxycxy, const Numbers& q,
                            const std::vector<Numbers>& pixels, double pixel_noise, double joint_noise) {
  if (fxycxy.values.size() != 4)
    throw ValueError(cat("calibrateCamera: fxycxy has ", fxycxy.values.size(), " entries; expected 4: fx fy cx cy"));
  MarkerImages images;
  images.points = points.matrix();
  images.fxycxy = fxycxy.values;
  images.q = q.matrix();
  for (const Numbers& image : pixels) images.pixels.push_back(image.matrix());
  CameraCalibration result;
  {
    const nb::gil_scoped_release unlock;
    result = calibrateCamera(config, camera, marker, images, {pixel_noise, joint_noise});
  }
  for (const std::string& warning : result.warnings) emitWarning(cat("calibrateCamera: ", inPython(warning)));
  return result;
}

/// A NextView with the scene of its plan.
struct PyNextView : NextView {
  std::shared_ptr<const Config> config;
};

PyNextView findView(const PyConfig& config, const OccupancyMap& map, const std::string& camera,
                    const PyMotionPlan& plan, double nearest, double farthest, double margin) {
  PyNextView view;
  view.config = std::make_shared<const Config>(config);
  const nb::gil_scoped_release unlock;
  static_cast<NextView&>(view) = nextView(*view.config, map, camera, plan, {nearest, farthest, margin});
  return view;
}

Frame& setCellsOf(Frame& frame, const ArrayArgument& data, const Numbers& size) {
  const nb::object array = nb::module_::import_("numpy").attr("ascontiguousarray")(data, "dtype"_a = "float64");
  const auto shape = nb::cast<std::vector<int>>(array.attr("shape"));
  Numbers numbers;
  if (shape.size() != 3 || !readNumbers(array, numbers) || size.values.size() != 3)
    throw ValueError(cat("setCells: data has ", shape.size(), " dimensions and size ", size.values.size(),
                         " numbers; expected a 3-D array of numbers, and 3 numbers"));
  Grid grid;
  grid.cells = {shape[0], shape[1], shape[2]};
  grid.values.assign(numbers.values.begin(), numbers.values.end());
  setCells(frame, std::move(grid), size.values);
  return frame;
}

void bindOccupancyMap(nb::module_& m) {
  nb::borrow<nb::class_<Frame>>(nb::type<Frame>())
      .def("setCells", setCellsOf, "data"_a, "size"_a, kChain, docs::perception::setCells);
  nb::enum_<CellState>(m, "CellState", nb::is_arithmetic(), "What an OccupancyMap knows of a cell.")
      .value("unseen", CellState::unseen, "It was in no image.")
      .value("hidden", CellState::hidden, "It was only ever behind something.")
      .value("free", CellState::free, "A camera looked through it, or a known shape was there.")
      .value("occupied", CellState::occupied, "Something unknown was measured in it.")
      .value("undecided", CellState::undecided, "Images show it, but only in part, as at the edges of things.");
  nb::class_<OccupancyMap>(m, "OccupancyMap", docs::perception::occupancyMap)
      .def("__init__", makeMap, "config"_a, "region"_a, "cell"_a = .01, nb::kw_only(),
           "free"_a = std::vector<std::string>(), docs::perception::makeMap)
      .def("update", updateMap, "config"_a, "views"_a, nb::kw_only(), "known"_a = nb::none(),
           nb::sig("def update(self, config: Config, views: DepthView | collections.abc.Sequence[DepthView], *, known: "
                   "SeenScene | None = None) -> list[str]"),
           docs::perception::updateMap)
      .def(
          "attach",
          [](const OccupancyMap& map, PyConfig& config, const std::string& unseen, const std::string& name) {
            map.attach(config, unseenFromName(unseen), name);
          },
          "config"_a, nb::kw_only(), "unseen"_a = "blocked", "name"_a = "map", docs::perception::attachMap)
      .def(
          "state",
          [](const OccupancyMap& map, const Numbers& points) -> nb::object {
            const std::vector<CellState> states = stateAt(map, points);
            return points.values.size() == 3 ? nb::cast(states.front()) : nb::cast(states);
          },
          "points"_a, docs::perception::stateAt,
          nb::sig("def state(self, points: numpy.typing.ArrayLike) -> CellState | list[CellState]"))
      .def_prop_ro("states", statesOf,
                   "The CellState of all cells as numbers, shape (nx, ny, nz), uint8: a copy. Cell (i, j, k) has its\n"
                   "middle at lower + cell (i + .5, j + .5, k + .5).")
      .def_prop_ro(
          "lower", [](const OccupancyMap& map) { return toNumpy(VectorXd(map.lower())); },
          "The corner of the region with the smallest coordinates, shape (3,), m.")
      .def_prop_ro("cell", &OccupancyMap::cell, "The side of a cell, m.")
      .def("__repr__", [](const OccupancyMap& map) { return cat("<", map.str(), ">"); })
      .def("__getstate__",
           [](const OccupancyMap& map) {
             const auto& c = map.counts();
             const Vector3d upper = map.lower() + map.cell() * Vector3d(c[0], c[1], c[2]);
             return nb::make_tuple(toNumpy(VectorXd(map.lower())), toNumpy(VectorXd(upper)), map.cell(),
                                   nb::bytes(reinterpret_cast<const char*>(map.states().data()), map.states().size()));
           })
      .def("__setstate__", [](OccupancyMap& self, const nb::tuple& t) {
        const Numbers lower = nb::cast<Numbers>(t[0]), upper = nb::cast<Numbers>(t[1]);
        new (&self) OccupancyMap(Config(), lower.values, upper.values, nb::cast<double>(t[2]));
        const nb::bytes bytes = nb::cast<nb::bytes>(t[3]);
        std::vector<CellState> states(bytes.size());
        for (std::size_t i = 0; i < states.size(); ++i) states[i] = CellState(bytes.c_str()[i]);
        self.setStates(std::move(states));
      });
}

void bindCalibration(nb::module_& m) {
  nb::class_<CameraCalibration>(m, "CameraCalibration", "The poses that calibrateCamera found.")
      .def_prop_ro(
          "camera", [](const CameraCalibration& c) { return seenPose(c.camera); },
          "Pose of the camera relative to its parent, shape (7,): x y z (m) qw qx qy qz.")
      .def_prop_ro(
          "marker", [](const CameraCalibration& c) { return seenPose(c.marker); },
          "Pose of the marker relative to its parent, shape (7,).")
      .def_prop_ro(
          "covariance", [](const CameraCalibration& c) { return toNumpy(c.covariance); },
          "Covariance of the camera's (x y z in m, rotation vector in rad), in the axes of its parent, shape (6, 6).")
      .def_prop_ro(
          "marker_covariance", [](const CameraCalibration& c) { return toNumpy(c.marker_covariance); },
          "The same of the marker, shape (6, 6).")
      .def_prop_ro(
          "free_directions", [](const CameraCalibration& c) { return toNumpy(c.free_directions); },
          "Unit displacements (camera, marker) that the images do not determine, shape (k, 12).")
      .def_ro("pixel_error", &CameraCalibration::pixel_error,
              "Root mean square of the distances between points and pixels in the images, pixels.")
      .def_ro("warnings", &CameraCalibration::warnings,
              "Sentences about directions that the images do not determine, and about points that fit badly.")
      .def("__repr__", [](const CameraCalibration& c) { return cat("<CameraCalibration: ", inPython(c.str()), ">"); });
  const CalibrateOptions defaults;
  m.def("calibrateCamera", calibrate, "config"_a, "camera"_a, "marker"_a, "points"_a, "fxycxy"_a, "q"_a, "pixels"_a,
        nb::kw_only(), "pixel_noise"_a = defaults.pixel_noise, "joint_noise"_a = defaults.joint_noise,
        docs::calibration::calibrateCamera);
}

void bindNextView(nb::module_& m) {
  nb::class_<PyNextView>(m, "NextView", "A configuration that holds a camera, and the motion to get there.")
      .def_prop_ro("feasible", &NextView::feasible, "True if there is such a configuration.")
      .def_prop_ro(
          "q", [](const PyNextView& v) { return toNumpy(v.q); },
          "The configuration, collision-free and within limits, shape (n,); empty if there is none.")
      .def_prop_ro(
          "pose", [](const PyNextView& v) { return toNumpy(VectorXd(v.pose.numbers())); },
          "Pose of the camera there, shape (7,).")
      .def_ro("visible", &NextView::visible, "Number of cells in question that the camera should see from there.")
      .def_ro("cells", &NextView::cells, "Number of cells in question.")
      .def_prop_ro(
          "plan", [](const PyNextView& v) { return PyMotionPlan(v.plan, v.config); },
          "The MotionPlan to `q` from the configuration of the scene.")
      .def_prop_ro(
          "message", [](const PyNextView& v) { return inPython(v.message); },
          "\"\" if there is a view, else why there is none.")
      .def("__repr__", [](const PyNextView& v) { return cat("<NextView: ", inPython(v.str()), ">"); });
  const NextViewOptions defaults;
  m.def("nextView", findView, "config"_a, "map"_a, "camera"_a, "plan"_a, nb::kw_only(), "nearest"_a = defaults.nearest,
        "farthest"_a = defaults.farthest, "margin"_a = defaults.margin, docs::calibration::nextView);
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
          "fx, fy, cx, cy in pixels, shape (4,).")
      .def("__repr__", [](const DepthView& v) {
        const auto measured = std::count_if(v.depth.begin(), v.depth.end(), isMeasured);
        return cat("<DepthView ", v.width, " x ", v.height, ", ", 100 * measured / std::ptrdiff_t(v.depth.size()),
                   " % measured, camera ", v.camera.empty() ? "at a pose" : cat("'", v.camera, "'"), ">");
      });
  bindSeenFrame(m);
  nb::class_<SeenCamera>(m, "SeenCamera", "A camera whose pose registerScene estimated.")
      .def_prop_ro(
          "pose", [](const SeenCamera& c) { return seenPose(c.pose); },
          "Pose relative to the camera's parent, shape (7,): x y z (m) qw qx qy qz; without a frame, in the world.")
      .def_prop_ro(
          "covariance", [](const SeenCamera& c) { return toNumpy(c.covariance); },
          "Covariance of (x y z in m, rotation vector in rad) in the axes of the parent, shape (6, 6).");
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
      .def_ro("cameras", &SeenScene::cameras, "The SeenCamera of each view; empty unless cameras were estimated.")
      .def_ro("joints", &SeenScene::joints, "Names of the joints whose offsets were estimated.")
      .def_prop_ro(
          "joint_offsets", [](const SeenScene& s) { return toNumpy(s.joint_offsets); },
          "What was added to the angles (rad) and lengths (m) of `joints`, shape (n,).")
      .def_prop_ro(
          "joint_covariance", [](const SeenScene& s) { return toNumpy(s.joint_covariance); },
          "Covariance of the offsets, shape (n, n).")
      .def_ro("warnings", &SeenScene::warnings, "Sentences about views without depth, doubtful cameras and overlaps.")
      .def("__repr__", [](const SeenScene& s) { return cat("<SeenScene\n", inPython(s.str()), ">"); });
  m.def("registerScene", registerFrames, "config"_a, "views"_a, "frames"_a, nb::kw_only(), "support"_a = nb::none(),
        "search_radius"_a = RegisterOptions().search_radius, "prior"_a = "last",
        "estimate"_a = std::vector<std::string>(),
        nb::sig("def registerScene(config: Config, views: DepthView | collections.abc.Sequence[DepthView], frames: "
                "collections.abc.Sequence[str], *, support: str | None = None, search_radius: float = 0.05, "
                "prior: str = 'last', estimate: collections.abc.Sequence[str] = ()) -> SeenScene"),
        docs::perception::registerScene);
  bindSeenCopies();
  bindOccupancyMap(m);
  bindSceneObserver(m);
  bindCalibration(m);
  bindNextView(m);
}

}  // namespace kinegraph::python
