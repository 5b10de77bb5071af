#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/api/robot_motion.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/tool_paths/plan_tool_path.h"
#include "kinegraph/trajectories/path_curve.h"
#include "kinegraph/trajectories/time_scaling.h"
#include "python_names.h"
#include "trajectories/first_contact.h"
#include "trajectories/retime_docs.h"

namespace kinegraph::python {

namespace {

using MaybeNumbers = std::optional<Numbers>;

/// Expands a limit for all dofs to one per dof; empty for None.
VectorXd perDof(const char* name, const MaybeNumbers& limit, Eigen::Index dofs) {
  if (!limit) return {};
  if (limit->rank == 0) return VectorXd::Constant(dofs, limit->values[0]);
  if (limit->rank != 1)
    throw ValueError(cat("retime: ", name, " has rank ", limit->rank, "; expected one number or one per dof"));
  return limit->values;
}

MatrixXd points(const Numbers& path) {
  if (path.rank != 2) throw ValueError(cat("retime: the path has rank ", path.rank, "; expected shape (K, n)"));
  return path.matrix();
}

/// The arguments of both overloads besides the limits.
struct Request {
  std::string corners;
  double tolerance;
  nb::object is_free;
  MaybeNumbers start_velocity, end_velocity, start_acceleration;
  int intervals;

  RetimeOptions options() const {
    RetimeOptions options;
    options.corners = cornersOfName(corners);
    options.tolerance = tolerance;
    options.intervals = intervals;
    options.cancellation = [check = CheckInterrupts()]() mutable { check(); };
    if (start_velocity) options.start_velocity = start_velocity->values;
    if (end_velocity) options.end_velocity = end_velocity->values;
    if (start_acceleration) options.start_acceleration = start_acceleration->values;
    if (!is_free.is_none())
      options.is_free = [function = is_free.ptr()](const MatrixXd& blend, double deviation) {
        const nb::gil_scoped_acquire lock;
        return bool(nb::bool_(nb::handle(function)(toNumpy(blend), deviation)));
      };
    return options;
  }
};

TimedPath ofPath(const Numbers& path, const Numbers& velocity, const Numbers& acceleration, const MaybeNumbers& jerk,
                 const Request& request) {
  const MatrixXd q = points(path);
  const MotionLimits limits{perDof("velocity", velocity, q.cols()), perDof("acceleration", acceleration, q.cols()),
                            perDof("jerk", jerk, q.cols())};
  const RetimeOptions options = request.options();
  const nb::gil_scoped_release unlock;
  return retime(q, limits, options);
}

/// The limits of a robot with so many dofs.
RobotLimits robotLimits(Eigen::Index dofs, const MaybeNumbers& velocity, const MaybeNumbers& acceleration,
                        const MaybeNumbers& jerk, bool torque, const std::map<std::string, double>& tool_speed) {
  return {{perDof("velocity", velocity, dofs), perDof("acceleration", acceleration, dofs), perDof("jerk", jerk, dofs)},
          torque,
          tool_speed};
}

TimedPath ofRobot(const PyConfig& config, const Numbers& path, const MaybeNumbers& velocity,
                  const MaybeNumbers& acceleration, const MaybeNumbers& jerk, bool torque,
                  const std::map<std::string, double>& tool_speed, const Request& request) {
  const MatrixXd q = points(path);
  const RobotLimits limits = robotLimits(q.cols(), velocity, acceleration, jerk, torque, tool_speed);
  const RetimeOptions options = request.options();
  const Config scene(config);  // a copy, because the caller may change it
  const nb::gil_scoped_release unlock;
  return retime(scene, q, limits, options);
}

TimedPath ofMotion(const PyConfig& config, const Trajectory& motion, const RobotLimits& limits,
                   const Request& request) {
  const RetimeOptions options = request.options();
  const Config scene(config);  // a copy, because the caller may change it
  const nb::gil_scoped_release unlock;
  return retime(scene, motion, limits, options);
}

nb::typed<nb::list, nb::tuple> activeLimitsOf(const PyConfig& config, const TimedPath& motion,
                                              const MaybeNumbers& velocity, const MaybeNumbers& acceleration,
                                              const MaybeNumbers& jerk, bool torque,
                                              const std::map<std::string, double>& tool_speed) {
  const RobotLimits limits = robotLimits(motion.dimension(), velocity, acceleration, jerk, torque, tool_speed);
  const Config scene(config);  // a copy, because the caller may change it
  const std::vector<ActiveLimit> all = [&] {
    const nb::gil_scoped_release unlock;
    return activeLimits(scene, motion, limits);
  }();
  nb::list list;
  for (const ActiveLimit& active : all) list.append(nb::make_tuple(active.from, active.to, active.share, active.cause));
  return list;
}

nb::tuple timedState(const TimedPath& t) {
  const PathCurve::Parts curve = t.curve().parts();
  const NewArray phases = newArray(t.scaling().phases().size(), 7);
  std::vector<int> pieces;
  double* to = phases.data;
  for (const ScalingPhase& p : t.scaling().phases()) {
    for (const double value : {p.time, p.begin.s, p.begin.speed, p.begin.acceleration, p.begin.jerk, p.growth, p.end})
      *to++ = value;
    pieces.push_back(p.piece);
  }
  return nb::make_tuple(int(t.status), t.message, toNumpy(t.path), toNumpy(t.times),
                        nb::make_tuple(curve.dofs, curve.degree, curve.length, curve.begin, curve.marks,
                                       curve.coefficients, curve.is_line, curve.stops),
                        phases.array, pieces, t.scaling().duration());
}

/// Restores the phases of a time scaling on a curve of so many pieces.
std::vector<ScalingPhase> phasesFrom(const VectorXd& numbers, const std::vector<int>& pieces, int curve_pieces) {
  if (std::size_t(numbers.size()) != 7 * pieces.size())
    throw ValueError(cat("TimedPath: the state has ", numbers.size(), " numbers for ", pieces.size(),
                         " phases; expected 7 per phase"));
  std::vector<ScalingPhase> phases;
  const double* from = numbers.data();
  for (const int piece : pieces) {
    if (piece < 0 || piece >= curve_pieces)
      throw ValueError(
          cat("TimedPath: the state has a phase on piece ", piece, " of a curve of ", curve_pieces, " pieces"));
    phases.push_back({from[0], {from[1], from[2], from[3], from[4]}, from[5], from[6], piece});
    from += 7;
  }
  return phases;
}

void setTimedState(TimedPath& t, const nb::tuple& state) {
  const nb::tuple c = nb::cast<nb::tuple>(state[4]);
  using Values = std::vector<double>;
  using Flags = std::vector<bool>;
  const PathCurve::Parts curve{nb::cast<int>(c[0]),    nb::cast<int>(c[1]),    nb::cast<double>(c[2]),
                               nb::cast<Values>(c[3]), nb::cast<Values>(c[4]), nb::cast<Values>(c[5]),
                               nb::cast<Flags>(c[6]),  nb::cast<Flags>(c[7])};
  std::vector<ScalingPhase> scaling =
      phasesFrom(nb::cast<Numbers>(state[5]).values, nb::cast<std::vector<int>>(state[6]), int(curve.begin.size()));
  const auto status = RetimeStatus(nb::cast<int>(state[0]));
  if (status == RetimeStatus::timed && scaling.empty())
    throw ValueError("TimedPath: the state has a motion without phases");
  new (&t) TimedPath(TimedPath::fromParts(status, nb::cast<std::string>(state[1]), nb::cast<Numbers>(state[2]).matrix(),
                                          nb::cast<Numbers>(state[3]).values, PathCurve::fromParts(curve),
                                          {std::move(scaling), nb::cast<double>(state[7])}));
}

void bindTimedPath(nb::module_& m) {
  nb::enum_<RetimeStatus>(m, "RetimeStatus", "Result of retime.")
      .value("timed", RetimeStatus::timed, "There is a motion.")
      .value("start_too_fast", RetimeStatus::start_too_fast,
             "The start velocity exceeds the limits, or is too high to brake.")
      .value("end_too_fast", RetimeStatus::end_too_fast, "The end velocity exceeds the limits, or is unreachable.")
      .value("cannot_move", RetimeStatus::cannot_move, "A torque limit holds for no speed at some point.");
  nb::class_<TimedPath, Trajectory>(m, "TimedPath", "A path with its time parameterization; a Trajectory.")
      .def_prop_ro("feasible", &TimedPath::feasible, "True if there is a motion.")
      .def_ro("status", &TimedPath::status, "Outcome, a RetimeStatus.")
      .def_prop_ro(
          "message", [](const TimedPath& t) { return inPython(t.message); },
          "\"\" if there is a motion; else the cause, with a value that would do.")
      .def_prop_ro(
          "path", [](const TimedPath& t) { return toNumpy(t.path); }, "The points of the path, shape (K, n).")
      .def_prop_ro(
          "times", [](const TimedPath& t) { return toNumpy(t.times); },
          "Times of the points, or of the nearest points of their blends, shape (K,), s; empty without a motion.")
      .def(
          "nearestLimit",
          [](const TimedPath& t, double time, const Numbers& velocity, const Numbers& acceleration,
             const MaybeNumbers& jerk) {
            const Eigen::Index n = t.dimension();
            const NearestLimit nearest = nearestLimit(
                t, time,
                {perDof("velocity", velocity, n), perDof("acceleration", acceleration, n), perDof("jerk", jerk, n)});
            return std::tuple(nearest.share, nearestLimitName(nearest.kind), nearest.dof);
          },
          "t"_a, "velocity"_a, "acceleration"_a, "jerk"_a = nb::none(), docs::retime::nearestLimit)
      .def("firstContact", firstContactOf<TimedPath>, "config"_a, "margin"_a = 0., docs::retime::firstContact)
      .def("__bool__", &TimedPath::feasible)
      .def("__getstate__", timedState)
      .def("__setstate__", setTimedState)
      .def("__repr__", [](const TimedPath& t) { return cat("<TimedPath ", inPython(t.str()), ">"); });
}

}  // namespace

void bindRetime(nb::module_& m) {
  bindTimedPath(m);
  m.def(
      "retime",
      [](const PyConfig& config, const Numbers& path, const MaybeNumbers& velocity, const MaybeNumbers& acceleration,
         const MaybeNumbers& jerk, bool torque, const std::string& corners, double tolerance,
         const std::optional<nb::callable>& is_free, const MaybeNumbers& start_velocity,
         const MaybeNumbers& end_velocity, int intervals, const MaybeNumbers& start_acceleration,
         const std::map<std::string, double>& tool_speed) {
        const Request request{corners,        tolerance,    is_free ? nb::object(*is_free) : nb::none(),
                              start_velocity, end_velocity, start_acceleration,
                              intervals};
        return ofRobot(config, path, velocity, acceleration, jerk, torque, tool_speed, request);
      },
      "config"_a, "path"_a, "velocity"_a = nb::none(), "acceleration"_a = nb::none(), "jerk"_a = nb::none(),
      nb::kw_only(), "torque"_a = false, "corners"_a = "blend", "tolerance"_a = .01, "is_free"_a = nb::none(),
      "start_velocity"_a = nb::none(), "end_velocity"_a = nb::none(), "intervals"_a = 100,
      "start_acceleration"_a = nb::none(), "tool_speed"_a = std::map<std::string, double>(), docs::retime::ofRobot);
  m.def(
      "retime",
      [](const PyConfig& config, const Trajectory& motion, const MaybeNumbers& velocity,
         const MaybeNumbers& acceleration, const MaybeNumbers& jerk, bool torque, const MaybeNumbers& start_velocity,
         const MaybeNumbers& end_velocity, int intervals, const MaybeNumbers& start_acceleration,
         const std::map<std::string, double>& tool_speed) {
        const RobotLimits limits = robotLimits(motion.dimension(), velocity, acceleration, jerk, torque, tool_speed);
        const Request request{"spline",     RetimeOptions().tolerance, nb::none(), start_velocity,
                              end_velocity, start_acceleration,        intervals};
        return ofMotion(config, motion, limits, request);
      },
      "config"_a, "motion"_a, "velocity"_a = nb::none(), "acceleration"_a = nb::none(), "jerk"_a = nb::none(),
      nb::kw_only(), "torque"_a = false, "start_velocity"_a = nb::none(), "end_velocity"_a = nb::none(),
      "intervals"_a = 1000, "start_acceleration"_a = nb::none(), "tool_speed"_a = std::map<std::string, double>(),
      docs::retime::ofMotion);
  m.def("activeLimits", activeLimitsOf, "config"_a, "motion"_a, "velocity"_a = nb::none(),
        "acceleration"_a = nb::none(), "jerk"_a = nb::none(), nb::kw_only(), "torque"_a = false,
        "tool_speed"_a = std::map<std::string, double>(), docs::retime::activeLimits);
  m.def(
      "retime",
      [](const Numbers& path, const Numbers& velocity, const Numbers& acceleration, const MaybeNumbers& jerk,
         const std::string& corners, double tolerance, const std::optional<nb::callable>& is_free,
         const MaybeNumbers& start_velocity, const MaybeNumbers& end_velocity, int intervals,
         const MaybeNumbers& start_acceleration) {
        const Request request{corners,        tolerance,    is_free ? nb::object(*is_free) : nb::none(),
                              start_velocity, end_velocity, start_acceleration,
                              intervals};
        return ofPath(path, velocity, acceleration, jerk, request);
      },
      "path"_a, "velocity"_a, "acceleration"_a, "jerk"_a = nb::none(), nb::kw_only(), "corners"_a = "blend",
      "tolerance"_a = .01, "is_free"_a = nb::none(), "start_velocity"_a = nb::none(), "end_velocity"_a = nb::none(),
      "intervals"_a = 100, "start_acceleration"_a = nb::none(), docs::retime::ofPath);
}

}  // namespace kinegraph::python
