#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/api/tool_path_view.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/log.h"
#include "kinegraph/common/text.h"
#include "kinegraph/tool_paths/plan_tool_path.h"
#include "progress_bar.h"
#include "python_names.h"
#include "tool_paths/tool_path_docs.h"
#include "tool_paths/tool_waypoint.h"
#include "trajectories/first_contact.h"
#include "trajectories/retime_docs.h"
#include "viewer/py_viewer.h"

namespace kinegraph::python {

ToolWaypoint waypointOf(const char* call, const VectorXd& numbers) {
  if (numbers.size() != 3 && numbers.size() != 7)
    throw ValueError(
        cat(call, ": the pose has ", numbers.size(), " numbers; expected 7 (x y z qw qx qy qz) or a position (3)"));
  if (numbers.size() == 3) return Vector3d(numbers);
  return Pose::fromNumbers(numbers);
}

namespace {

namespace doc = docs::tool_path;
using MaybeVector = std::optional<Numbers>;

Vector3d vector3(const char* call, const char* name, const Numbers& numbers) {
  if (numbers.values.size() != 3)
    throw ValueError(cat("ToolPath.", call, ": ", name, " has ", numbers.values.size(), " numbers; expected 3"));
  return numbers.values;
}

ToolWaypoint waypoint(const char* call, const VectorXd& numbers) {
  return waypointOf(cat("ToolPath.", call).c_str(), numbers);
}

MatrixXd rows(const char* call, const Numbers& numbers) {
  if (numbers.rank != 2)
    throw ValueError(
        cat("ToolPath.", call, ": the rows have rank ", numbers.rank, "; expected shape (K, 3) or (K, 7)"));
  return numbers.matrix();
}

int axisNumber(const std::string& about) {
  const std::size_t axis = std::string("xyz").find(about);
  if (about.size() != 1 || axis == std::string::npos)
    throw ValueError(cat("ToolPath.free: about is '", about, "'; expected one of x, y, z"));
  return int(axis);
}

/// Warns of what a method added to the warnings of a path.
template <class Call>
ToolPath& warningOfNew(ToolPath& path, const Call& call) {
  const std::size_t before = path.warnings().size();
  call();
  for (std::size_t k = before; k < path.warnings().size(); ++k) emitWarning(cat("ToolPath.", path.warnings()[k]));
  return path;
}

/// A pose (7,), or a position (3,) without a rotation.
VectorXd numbersOf(const ToolWaypoint& waypoint) {
  VectorXd numbers(waypoint.rotation ? 7 : 3);
  numbers.head<3>() = waypoint.p;
  if (waypoint.rotation) numbers.tail<4>() << waypoint.rotation->w(), waypoint.rotation->vec();
  return numbers;
}

/// The same waypoint, to the last bit.
ToolWaypoint waypointFrom(nb::handle state) {
  const VectorXd numbers = nb::cast<Numbers>(state).values;
  ToolWaypoint waypoint;
  if (numbers.size() != 3 && numbers.size() != 7)
    throw ValueError(cat("ToolPath: the state has a pose of ", numbers.size(), " numbers; expected 3 or 7"));
  waypoint.p = numbers.head<3>();
  if (numbers.size() == 7) waypoint.rotation = Quaterniond(numbers[3], numbers[4], numbers[5], numbers[6]);
  return waypoint;
}

nb::tuple toolPathState(const ToolPath& path) {
  const ToolPath::Parts& p = path.parts();
  nb::list elements;
  for (const ToolPathElement& e : p.elements) {
    nb::list waypoints;
    for (const ToolWaypoint& waypoint : e.waypoints) waypoints.append(toNumpy(numbersOf(waypoint)));
    elements.append(nb::make_tuple(int(e.kind), waypoints, toNumpy(VectorXd(e.center)), toNumpy(VectorXd(e.axis)),
                                   e.angle, e.advance, e.blend, e.speed));
  }
  const nb::object first = p.first ? nb::object(toNumpy(numbersOf(*p.first))) : nb::none();
  return nb::make_tuple(p.frame, p.relative_to, first, elements, p.free_axis, p.cone, p.speed, p.range, p.prefer,
                        p.warnings);
}

void setToolPathState(ToolPath& path, const nb::tuple& state) {
  ToolPath::Parts p{nb::cast<std::string>(state[0]), nb::cast<std::string>(state[1])};
  if (!state[2].is_none()) p.first = waypointFrom(state[2]);
  for (nb::handle e : state[3]) {
    ToolPathElement element{ToolPathElement::Kind(nb::cast<int>(e[0]))};
    for (nb::handle waypoint : e[1]) element.waypoints.push_back(waypointFrom(waypoint));
    element.center = vector3("__setstate__", "center", nb::cast<Numbers>(e[2]));
    element.axis = vector3("__setstate__", "axis", nb::cast<Numbers>(e[3]));
    element.angle = nb::cast<double>(e[4]), element.advance = nb::cast<double>(e[5]);
    element.blend = nb::cast<double>(e[6]), element.speed = nb::cast<double>(e[7]);
    p.elements.push_back(std::move(element));
  }
  p.free_axis = nb::cast<int>(state[4]), p.cone = nb::cast<double>(state[5]), p.speed = nb::cast<double>(state[6]);
  p.range = nb::cast<std::optional<std::pair<double, double>>>(state[7]);
  p.prefer = nb::cast<std::optional<double>>(state[8]);
  p.warnings = nb::cast<std::vector<std::string>>(state[9]);
  new (&path) ToolPath(ToolPath::fromParts(std::move(p)));
}

void bindToolPath(nb::module_& m) {
  nb::class_<ToolPath>(m, "ToolPath", doc::ToolPath)
      .def(
          "__init__",
          [](ToolPath* self, const std::string& frame, const std::optional<std::string>& relative_to) {
            new (self) ToolPath(frame, relative_to.value_or(""));
          },
          "frame"_a, "relativeTo"_a = nb::none(), doc::make)
      .def_static(
          "along",
          [](const Numbers& points, const MaybeVector& normals, const std::string& frame,
             const std::optional<std::string>& relative_to) {
            return ToolPath::along(frame, rows("along", points), normals ? rows("along", *normals) : MatrixXd(),
                                   relative_to.value_or(""));
          },
          "points"_a, "normals"_a = nb::none(), nb::kw_only(), "frame"_a = "tool", "relativeTo"_a = nb::none(),
          doc::along)
      .def_static(
          "read",
          [](const PathText& file, const std::string& frame, const std::optional<std::string>& relative_to) {
            return ToolPath::read(file.text, frame, relative_to.value_or(""));
          },
          "file"_a, nb::kw_only(), "frame"_a = "tool", "relativeTo"_a = nb::none(), doc::read)
      .def_static(
          "readGcode",
          [](const PathText& file, const std::string& frame, const std::optional<std::string>& relative_to,
             double blend) { return ToolPath::readGcode(file.text, frame, relative_to.value_or(""), blend); },
          "file"_a, nb::kw_only(), "frame"_a = "tool", "relativeTo"_a = nb::none(), "blend"_a = 0., doc::readGcode)
      .def(
          "start",
          [](ToolPath& path, const Numbers& pose) -> ToolPath& { return path.start(waypoint("start", pose.values)); },
          "pose"_a, kChain, doc::start)
      .def(
          "line",
          [](ToolPath& path, const Numbers& pose, double blend) -> ToolPath& {
            return path.line(waypoint("line", pose.values), blend);
          },
          "pose"_a, "blend"_a = 0., kChain, doc::line)
      .def(
          "arc",
          [](ToolPath& path, const Numbers& via, const Numbers& pose, double blend) -> ToolPath& {
            if (via.values.size() == 7) return path.arc(via.values.head<3>(), waypoint("arc", pose.values), blend);
            return path.arc(vector3("arc", "via", via), waypoint("arc", pose.values), blend);
          },
          "via"_a, "pose"_a, "blend"_a = 0., kChain, doc::arc)
      .def(
          "circle",
          [](ToolPath& path, const Numbers& center, const Numbers& axis, double angle, double blend,
             double advance) -> ToolPath& {
            return warningOfNew(path, [&] {
              path.circle(vector3("circle", "center", center), vector3("circle", "axis", axis), angle, blend, advance);
            });
          },
          "center"_a, "axis"_a, "angle"_a, "blend"_a = 0., "advance"_a = 0., kChain, doc::circle)
      .def(
          "spline",
          [](ToolPath& path, const Numbers& poses) -> ToolPath& {
            const MatrixXd all = rows("spline", poses);
            std::vector<ToolWaypoint> waypoints;
            for (Eigen::Index k = 0; k < all.rows(); ++k)
              waypoints.push_back(waypoint("spline", all.row(k).transpose()));
            return path.spline(std::move(waypoints));
          },
          "poses"_a, kChain, doc::spline)
      .def(
          "speed", [](ToolPath& path, double speed) -> ToolPath& { return path.speed(speed); }, "speed"_a, kChain,
          doc::speedOfElements)
      .def(
          "free",
          [](ToolPath& path, const std::string& about, const std::optional<std::pair<double, double>>& range,
             const std::optional<double>& prefer) -> ToolPath& {
            return warningOfNew(path, [&] { path.free(axisNumber(about), range, prefer); });
          },
          "about"_a = "z", "range"_a = nb::none(), "prefer"_a = nb::none(), kChain, doc::free)
      .def(
          "tilt", [](ToolPath& path, double angle) -> ToolPath& { return path.tilt(angle); }, "angle"_a, kChain,
          doc::tilt)
      .def(
          "lean", [](ToolPath& path, double travel, double work) -> ToolPath& { return path.lean(travel, work); },
          "travel"_a, "work"_a = 0., kChain, doc::lean)
      .def_prop_ro("frame", &ToolPath::frame, "Name of the frame that moves.")
      .def_prop_ro("warnings", &ToolPath::warnings,
                   "Sentences about what was ignored in a file, such as spindle commands, with file:line:column, and "
                   "about angles that may be in degrees.")
      .def("__getstate__", toolPathState)
      .def("__setstate__", setToolPathState)
      .def("__repr__", [](const ToolPath& path) { return cat("<ToolPath ", path.str(), ">"); });
}

std::vector<ToolPath> pathsFrom(nb::handle paths) {
  ToolPath* one = nullptr;
  if (nb::try_cast(paths, one)) return {*one};
  std::vector<ToolPath> all;
  if (!nb::try_cast(paths, all))
    throw ValueError(cat("planToolPath: paths is ", nb::cast<std::string>(nb::repr(paths)),
                         "; expected a ToolPath or a sequence of them"));
  return all;
}

nb::typed<nb::list, nb::tuple> toolPathSegments(const ToolPathPlan& plan) {
  nb::list list;
  for (const ToolSegment& s : plan.segments)
    list.append(nb::make_tuple(toolSegmentName(s.kind), s.path, s.reversed, s.from, s.to));
  return list;
}

nb::typed<nb::list, nb::tuple> slow(const ToolPathPlan& plan) {
  nb::list list;
  for (const SlowStretch& s : plan.slow) list.append(nb::make_tuple(s.path, s.from, s.to, s.speed, s.cause));
  return list;
}

nb::tuple toolPlanState(const ToolPathPlan& p) {
  nb::list parts;
  for (const ToolPathPlan::Part& part : p.parts())
    parts.append(nb::make_tuple(part.begin, part.path, part.offset, part.is_transfer, part.timed));
  nb::list kinds;
  for (const ToolSegment& s : p.segments) kinds.append(nb::make_tuple(int(s.kind), s.path, s.reversed, s.from, s.to));
  return nb::make_tuple(int(p.status), p.message, p.warnings, nb::make_tuple(p.where.path, p.where.place), p.frames,
                        p.joint, toNumpy(p.reached), kinds, slow(p), p.position_deviation, p.rotation_deviation, parts,
                        p.dimension());
}

void setToolPlanState(ToolPathPlan& plan, const nb::tuple& t) {
  ToolPathPlan p;
  p.status = ToolPathStatus(nb::cast<int>(t[0]));
  p.message = nb::cast<std::string>(t[1]);
  p.warnings = nb::cast<std::vector<std::string>>(t[2]);
  p.where = {nb::cast<int>(t[3][0]), nb::cast<double>(t[3][1])};
  p.frames = nb::cast<std::vector<std::string>>(t[4]);
  p.joint = nb::cast<std::string>(t[5]);
  p.reached = nb::cast<Numbers>(t[6]).matrix();
  for (nb::handle s : t[7])
    p.segments.push_back({ToolSegment::Kind(nb::cast<int>(s[0])), nb::cast<int>(s[1]), nb::cast<bool>(s[2]),
                          nb::cast<double>(s[3]), nb::cast<double>(s[4])});
  for (nb::handle s : t[8])
    p.slow.push_back({nb::cast<int>(s[0]), nb::cast<double>(s[1]), nb::cast<double>(s[2]), nb::cast<double>(s[3]),
                      nb::cast<std::string>(s[4])});
  p.position_deviation = nb::cast<double>(t[9]);
  p.rotation_deviation = nb::cast<double>(t[10]);
  std::vector<ToolPathPlan::Part> parts;
  for (nb::handle s : t[11])
    parts.push_back({nb::cast<double>(s[0]), nb::cast<int>(s[1]), nb::cast<double>(s[2]), nb::cast<bool>(s[3]),
                     nb::cast<TimedPath>(s[4])});
  p.setParts(std::move(parts), nb::cast<int>(t[12]));
  new (&plan) ToolPathPlan(std::move(p));
}

int viewToolPlan(const ToolPathPlan& plan, PyConfig& config, nb::handle paths, bool pause) {
  const Config shown(config);
  if (!config.viewer) config.viewer = std::make_shared<PyViewer>();
  drawToolPaths(*config.viewer, shown, pathsFrom(paths), plan);
  const ShownMotion motion = shownToolPath(plan, shown);
  if (motion.poses.empty()) return viewOnPage(config, shown, pause, inPython(plan.message));
  return playOnPage(config, shown, motion, pause, inPython(plan.str()));
}

void bindToolPathPlan(nb::module_& m) {
  nb::enum_<ToolPathStatus>(m, "ToolPathStatus", "Result of planToolPath.")
      .value("solved", ToolPathStatus::solved, "There is a motion.")
      .value("out_of_reach", ToolPathStatus::out_of_reach, "No configuration reaches a place of a path.")
      .value("in_collision", ToolPathStatus::in_collision, "All configurations at a place are in collision.")
      .value("no_branch", ToolPathStatus::no_branch, "Joint limits or a singularity end every motion.")
      .value("too_fast", ToolPathStatus::too_fast, "There is no timing.")
      .value("no_transfer", ToolPathStatus::no_transfer, "No motion leads to the start of a path.")
      .value("out_of_time", ToolPathStatus::out_of_time, "The time limit ended the search.");
  nb::class_<ToolPathPlan, Trajectory>(m, "ToolPathPlan", doc::ToolPathPlan)
      .def_prop_ro("feasible", &ToolPathPlan::feasible, "True if there is a motion.")
      .def("__bool__", &ToolPathPlan::feasible)
      .def_ro("status", &ToolPathPlan::status, "Outcome, a ToolPathStatus.")
      .def_prop_ro(
          "message", [](const ToolPathPlan& p) { return inPython(p.message); },
          "\"\" if there is a motion; else the path, the place on it, and the cause.")
      .def_ro("warnings", &ToolPathPlan::warnings, "Sentences, such as of blends that were made smaller.")
      .def_prop_ro(
          "where", [](const ToolPathPlan& p) { return std::pair(p.where.path, p.where.place); },
          "Place of the failure: index of the path, and m from its start; path -1 if there is a motion.")
      .def_ro("frames", &ToolPathPlan::frames, "The pair in collision at the place of the failure, or [].")
      .def_ro("joint", &ToolPathPlan::joint,
              "The joint whose limit ends the motion at the place of the failure, or \"\".")
      .def_prop_ro(
          "reached", [](const ToolPathPlan& p) { return toNumpy(p.reached); },
          "Without a motion: configurations up to the place of the failure, shape (K, n).")
      .def_prop_ro("segments", toolPathSegments,
                   "Parts of the motion in the order of time: (kind, path, reversed, from, to). kind is \"transfer\", "
                   "\"approach\", \"path\" or \"retract\"; from and to are times, s.")
      .def_prop_ro("slow", slow,
                   "Stretches on which the tool is slower than asked: (path, from, to, speed, cause), in m from the "
                   "start of the path in the direction of motion, and m/s. cause is such as \"velocity of 'wrist_2'\".")
      .def_prop_ro(
          "deviation", [](const ToolPathPlan& p) { return std::pair(p.position_deviation, p.rotation_deviation); },
          "Bounds of the distance (m) and the rotation (rad) of the tool from its paths, proven for all times.")
      .def(
          "way",
          [](const ToolPathPlan& p, double t) {
            const ToolPlace place = p.way(t);
            return std::pair(place.path, place.place);
          },
          "t"_a, doc::way)
      .def("speed", &ToolPathPlan::speed, "t"_a, doc::speed)
      .def("firstContact", firstContactOf<ToolPathPlan>, "config"_a, "margin"_a = 0., docs::retime::firstContact)
      .def("view", viewToolPlan, "config"_a, "paths"_a, "pause"_a = false, doc::view)
      .def("__getstate__", toolPlanState)
      .def("__setstate__", setToolPlanState)
      .def("__repr__", [](const ToolPathPlan& p) { return cat("<ToolPathPlan ", inPython(p.str()), ">"); });
}

}  // namespace

void bindToolPaths(nb::module_& m) {
  bindToolPath(m);
  bindToolPathPlan(m);
  m.def(
      "planToolPath",
      [](const PyConfig& config, nb::handle paths, double speed, const std::string& order, double approach,
         double retract, const std::string& flow, double tolerance, double rotation_tolerance, double margin,
         const std::vector<std::string>& touching, const MaybeVector& start, const MaybeVector& transfer_from,
         const MaybeVector& velocity, const MaybeVector& acceleration, const MaybeVector& jerk,
         double tool_acceleration, double tool_jerk, const std::optional<double>& time_limit, std::uint64_t seed,
         int verbose) {
        ToolPathOptions options;
        if (order != "free" && order != "given")
          throw ValueError(cat("planToolPath: order is '", order, "'; expected 'given' or 'free'"));
        options.free_order = order == "free";
        options.flow = transferFlowOfName(flow);
        options.speed = speed, options.approach = approach, options.retract = retract;
        options.tolerance = tolerance, options.rotation_tolerance = rotation_tolerance, options.margin = margin;
        options.touching = touching;
        options.tool_acceleration = tool_acceleration, options.tool_jerk = tool_jerk, options.seed = seed;
        if (start) options.start = start->values;
        if (transfer_from) options.transfer_from = transfer_from->values;
        if (velocity) options.velocity = velocity->values;
        if (acceleration) options.acceleration = acceleration->values;
        if (jerk) options.jerk = jerk->values;
        if (time_limit) options.time_limit = *time_limit;
        const std::vector<ToolPath> all = pathsFrom(paths);
        const Config scene(config);  // a copy, because the caller may change it
        ProgressBar bar("planToolPath", verbose);
        ToolPathPlan plan = [&] {
          const nb::gil_scoped_release unlock;
          return planToolPath(
              scene, all, options, [&bar] { bar.check(); }, std::ref(bar));
        }();
        bar.finish(plan.feasible());
        if (verbose > 0)
          logMessage(LogLevel::info, cat("planToolPath: ", inPython(plan.str()), ", ", bar.seconds(), " s"));
        return plan;
      },
      "config"_a, "paths"_a, nb::kw_only(), "speed"_a = .1, "order"_a = "given", "approach"_a = 0., "retract"_a = 0.,
      "flow"_a = "approach", "tolerance"_a = 2e-5, "rotation_tolerance"_a = 8e-5, "margin"_a = 0.,
      "touching"_a = std::vector<std::string>(), "start"_a = nb::none(), "transfer_from"_a = nb::none(),
      "velocity"_a = nb::none(), "acceleration"_a = nb::none(), "jerk"_a = nb::none(), "tool_acceleration"_a = 2.,
      "tool_jerk"_a = 40., "time_limit"_a = nb::none(), "seed"_a = 0, "verbose"_a = 0, doc::plan);
}

}  // namespace kinegraph::python
