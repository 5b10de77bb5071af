#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "arguments.h"
#include "bindings.h"
#include "docs/retime.h"
#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/front/retime_robot.h"

namespace kinegraph::python {

namespace {

using MaybeNumbers = std::optional<Numbers>;

/// One limit for all dofs, or one per dof; none if there is none.
VectorXd perDof(const char* name, const MaybeNumbers& given, Eigen::Index dofs) {
  if (!given) return {};
  if (given->rank == 0) return VectorXd::Constant(dofs, given->values[0]);
  if (given->rank != 1)
    throw ValueError(cat("retime: ", name, " has rank ", given->rank, "; expected one number or one per dof"));
  return given->values;
}

MatrixXd points(const Numbers& path) {
  if (path.rank != 2) throw ValueError(cat("retime: the path has rank ", path.rank, "; expected shape (K, n)"));
  return path.matrix();
}

/// What both calls take beside the limits.
struct Request {
  std::string corners;
  double tolerance;
  nb::object is_free;
  MaybeNumbers start_velocity, end_velocity;
  int intervals;

  RetimeOptions options() const {
    RetimeOptions options;
    options.corners = cornersOfName(corners);
    options.tolerance = tolerance;
    options.intervals = intervals;
    if (start_velocity) options.start_velocity = start_velocity->values;
    if (end_velocity) options.end_velocity = end_velocity->values;
    if (!is_free.is_none())
      options.is_free = [asked = is_free.ptr()](const MatrixXd& blend, double deviation) {
        const nb::gil_scoped_acquire lock;
        return bool(nb::bool_(nb::handle(asked)(toNumpy(blend), deviation)));
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

TimedPath ofRobot(const PyConfig& config, const Numbers& path, const MaybeNumbers& velocity,
                  const MaybeNumbers& acceleration, const MaybeNumbers& jerk, bool torque, const Request& request) {
  const MatrixXd q = points(path);
  const RobotLimits limits{{perDof("velocity", velocity, q.cols()), perDof("acceleration", acceleration, q.cols()),
                            perDof("jerk", jerk, q.cols())},
                           torque};
  return retime(config, q, limits, request.options());
}

nb::typed<nb::tuple, Array, Array, Array> stateAt(const TimedPath& timed, const Numbers& t) {
  const std::size_t n = std::size_t(timed.path.cols()), count = std::size_t(t.values.size());
  if (t.rank > 1) throw ValueError(cat("retime: at(t) has t of rank ", t.rank, "; expected a number or shape (M,)"));
  const auto make = [&] { return t.rank == 0 ? newArray(n) : newArray(count, n); };
  NewArray q = make(), velocity = make(), acceleration = make();
  for (std::size_t i = 0; i < count; ++i)
    timed.at(t.values[Eigen::Index(i)], q.data + i * n, velocity.data + i * n, acceleration.data + i * n);
  return nb::typed<nb::tuple, Array, Array, Array>(nb::make_tuple(q.array, velocity.array, acceleration.array));
}

void bindTimedPath(nb::module_& m) {
  nb::enum_<RetimeStatus>(m, "RetimeStatus", "How retime ended.")
      .value("timed", RetimeStatus::timed, "There is a motion.")
      .value("start_too_fast", RetimeStatus::start_too_fast,
             "The start velocity is above the limits, or cannot be braked.")
      .value("end_too_fast", RetimeStatus::end_too_fast, "The end velocity is above the limits, or cannot be reached.")
      .value("cannot_move", RetimeStatus::cannot_move, "A torque limit holds for no speed somewhere.");
  nb::class_<TimedPath>(m, "TimedPath", "A path, and when a motion is where on it.")
      .def_prop_ro("feasible", &TimedPath::feasible, "True if there is a motion.")
      .def_ro("status", &TimedPath::status, "How it ended, a RetimeStatus.")
      .def_ro("message", &TimedPath::message, "\"\" if there is a motion; else what is too fast, and what would do.")
      .def_prop_ro(
          "path", [](const TimedPath& t) { return toNumpy(t.path); }, "The points, shape (K, n), as given.")
      .def_prop_ro(
          "times", [](const TimedPath& t) { return toNumpy(t.times); },
          "When the motion is at each point, or nearest to it in a blend, shape (K,), s; empty without a motion.")
      .def_prop_ro("duration", &TimedPath::duration, "How long the motion takes, s.")
      .def("at", stateAt, "t"_a, docs::retime::at)
      .def("__bool__", &TimedPath::feasible)
      .def("__repr__", [](const TimedPath& t) { return cat("<TimedPath ", t.str(), ">"); });
}

}  // namespace

void bindRetime(nb::module_& m) {
  bindTimedPath(m);
  m.def(
      "retime",
      [](const PyConfig& config, const Numbers& path, const MaybeNumbers& velocity, const MaybeNumbers& acceleration,
         const MaybeNumbers& jerk, bool torque, const std::string& corners, double tolerance,
         const std::optional<nb::callable>& is_free, const MaybeNumbers& start_velocity,
         const MaybeNumbers& end_velocity, int intervals) {
        const Request request{corners,        tolerance,    is_free ? nb::object(*is_free) : nb::none(),
                              start_velocity, end_velocity, intervals};
        return ofRobot(config, path, velocity, acceleration, jerk, torque, request);
      },
      "config"_a, "path"_a, "velocity"_a = nb::none(), "acceleration"_a = nb::none(), "jerk"_a = nb::none(),
      nb::kw_only(), "torque"_a = false, "corners"_a = "blend", "tolerance"_a = .01, "is_free"_a = nb::none(),
      "start_velocity"_a = nb::none(), "end_velocity"_a = nb::none(), "intervals"_a = 100, docs::retime::ofRobot);
  m.def(
      "retime",
      [](const Numbers& path, const Numbers& velocity, const Numbers& acceleration, const MaybeNumbers& jerk,
         const std::string& corners, double tolerance, const std::optional<nb::callable>& is_free,
         const MaybeNumbers& start_velocity, const MaybeNumbers& end_velocity, int intervals) {
        const Request request{corners,        tolerance,    is_free ? nb::object(*is_free) : nb::none(),
                              start_velocity, end_velocity, intervals};
        return ofPath(path, velocity, acceleration, jerk, request);
      },
      "path"_a, "velocity"_a, "acceleration"_a, "jerk"_a = nb::none(), nb::kw_only(), "corners"_a = "blend",
      "tolerance"_a = .01, "is_free"_a = nb::none(), "start_velocity"_a = nb::none(), "end_velocity"_a = nb::none(),
      "intervals"_a = 100, docs::retime::ofPath);
}

}  // namespace kinegraph::python
