#include "planning/plan_arguments.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <map>

#include "planning/plan_objects.h"

namespace kinegraph::python {

namespace {

/// An option that is no entry of the option table.
struct LargeOption {
  const char *name, *type, *default_value, *doc;
  bool only_planned = false;  ///< an option of planMotion alone
};

constexpr const char* kLimit = "numpy.typing.ArrayLike | None";
constexpr LargeOption kLargeOptions[] = {
    {"velocity", kLimit, "None",
     "Limit of |dq/dt|, a number or one per joint, rad/s or m/s. None: the model's velocities, or 1 if it has none."},
    {"acceleration", kLimit, "None",
     "Limit of |d2q/dt2|, a number or one per joint. None: full speed within a quarter of a second."},
    {"jerk", kLimit, "None", "Limit of |d3q/dt3|, a number or one per joint. None: no limit."},
    {"constraints", "MotionConstraint | collections.abc.Sequence[MotionConstraint]", "()",
     "MotionConstraints of the whole path."},
    {"start_velocity", kLimit, "None", "Initial dq/dt, shape (n,), rad/s or m/s. None: at rest.", true},
    {"start_acceleration", kLimit, "None", "Initial d2q/dt2, shape (n,). Needs start_velocity and jerk. None: zero.",
     true},
    {"end_velocity", kLimit, "None",
     "Final dq/dt, shape (n,). Needs one goal configuration and a start at rest. None: at rest.", true},
    {"end_acceleration", kLimit, "None", "Final d2q/dt2, shape (n,). Needs end_velocity and jerk. None: zero.", true},
    {"obstacle_trajectories",
     "collections.abc.Mapping[str, tuple[numpy.typing.ArrayLike, numpy.typing.ArrayLike]] | None", "None",
     "Dynamic obstacles: frame -> (times, values). Times have shape (K,), s from the start of the motion; values are "
     "poses in the world (K, 7), or positions of the frame's joint (K, d), which is no part of q. Values are "
     "interpolated linearly, and constant before the first and after the last time. The motion avoids the obstacles, "
     "waits if necessary, and can stay at its end."}};

bool takes(PlanCall call, const LargeOption& option) {
  const bool is_obstacles = std::string(option.name) == "obstacle_trajectories";
  return call == PlanCall::plan || !(option.only_planned || (is_obstacles && call == PlanCall::plans));
}

using Row = OptionTable<PlanOptions>::Row;

std::string typeOf(const Row& row) {
  if (!row.choices.empty()) {
    std::vector<std::string> quoted;
    for (const std::string& choice : row.choices) quoted.push_back(cat("'", choice, "'"));
    return cat("typing.Literal[", join(quoted), "]");
  }
  return std::visit(
      [](auto member) -> std::string {
        using Value = std::decay_t<decltype(std::declval<PlanOptions&>().*member)>;
        return std::is_same_v<Value, double> ? "float" : std::is_same_v<Value, bool> ? "bool" : "int";
      },
      row.member);
}

std::string defaultOf(const Row& row) {
  const PlanOptions defaults;
  const std::string text =
      std::visit([&](auto member) { return nb::cast<std::string>(nb::repr(nb::cast(defaults.*member))); }, row.member);
  return text == "inf" ? "float('inf')" : text;
}

/// A number per dof, or one for all.
VectorXd limitOf(const char* name, nb::handle value) {
  Numbers numbers;
  if (!readNumbers(value, numbers) || numbers.rank > 1)
    throw ValueError(cat("planMotion: ", name, " is ", nb::cast<std::string>(nb::repr(value)),
                         "; expected a number, or one per joint"));
  return numbers.values;
}

std::vector<ObstacleTrajectory> obstaclesOf(nb::handle value) {
  constexpr const char* kExpected =
      "expected a dict of frame -> (times, values), with values of shape (K, 7), poses, or (K, d), positions of its "
      "joint";
  if (!nb::isinstance<nb::dict>(value))
    throw ValueError(
        cat("planMotion: obstacle_trajectories is ", nb::cast<std::string>(nb::repr(value)), "; ", kExpected));
  std::vector<ObstacleTrajectory> all;
  for (const auto& [key, entry] : nb::borrow<nb::dict>(value)) {
    std::string frame;
    std::vector<nb::object> parts;
    Numbers times, values;
    const bool fits = nb::try_cast(key, frame) && nb::try_cast(entry, parts) && parts.size() == 2 &&
                      readNumbers(parts[0], times) && times.rank == 1 && readNumbers(parts[1], values) &&
                      values.rank == 2;
    if (!fits)
      throw ValueError(
          cat("planMotion: obstacle_trajectories[", nb::cast<std::string>(nb::repr(key)), "]: ", kExpected));
    all.push_back({frame, times.values, values.matrix()});
  }
  return all;
}

void setLargeOption(const OptionClass<PlanOptions>&, PlanOptions& options, const std::string& name, nb::handle value) {
  if (name == "constraints") {
    options.constraints = planConstraintsOf(value);
  } else if (name == "obstacle_trajectories") {
    options.obstacle_trajectories = value.is_none() ? std::vector<ObstacleTrajectory>() : obstaclesOf(value);
  } else if (!value.is_none()) {
    static const std::map<std::string, VectorXd PlanOptions::*> members = {
        {"velocity", &PlanOptions::velocity},
        {"acceleration", &PlanOptions::acceleration},
        {"jerk", &PlanOptions::jerk},
        {"start_velocity", &PlanOptions::start_velocity},
        {"start_acceleration", &PlanOptions::start_acceleration},
        {"end_velocity", &PlanOptions::end_velocity},
        {"end_acceleration", &PlanOptions::end_acceleration}};
    options.*members.at(name) = limitOf(name.c_str(), value);
  }
}

}  // namespace

std::string planArguments(PlanCall call) {
  std::vector<std::string> arguments;
  const auto add = [&](const std::string& name, const std::string& type, const std::string& default_value) {
    if (call == PlanCall::replan) {
      const bool has_none = type.ends_with("| None");
      arguments.push_back(cat(name, ": ", type, has_none ? "" : " | None", " = None"));
    } else {
      arguments.push_back(cat(name, ": ", type, " = ", default_value));
    }
  };
  for (const Row& row : planOptionTable().rows()) add(row.name, typeOf(row), defaultOf(row));
  for (const LargeOption& option : kLargeOptions)
    if (takes(call, option)) add(option.name, option.type, option.default_value);
  if (call == PlanCall::plan) add("verbose", "int", "0");
  return join(arguments);
}

std::string planArgumentDocs(PlanCall call) {
  std::string text;
  for (const Row& row : planOptionTable().rows())
    text += cat("    ", row.name, ": ", row.doc, *row.unit ? cat(" In ", row.unit, ".") : "", "\n");
  for (const LargeOption& option : kLargeOptions)
    if (takes(call, option)) text += cat("    ", option.name, ": ", option.doc, "\n");
  if (call == PlanCall::plan)
    text += "    verbose: 1 logs a line at the end, and shows the time on a terminal during long searches.\n";
  return text;
}

PlanOptions planOptionsFrom(nb::kwargs arguments, PlanCall call, PlanOptions options) {
  nb::dict values;
  for (const auto& [name, value] : arguments) {
    const std::string key = nb::cast<std::string>(name);
    if (call == PlanCall::replan && (key.starts_with("start_") || key.starts_with("end_")))
      throw ValueError(cat("MotionPlan.replan: there is no option ", key,
                           "; the new motion continues the running one and ends at rest"));
    if (call != PlanCall::replan || !value.is_none()) values[name] = value;
  }
  planOptionClass().setFields(options, values);
  return options;
}

const OptionClass<PlanOptions>& planOptionClass() {
  static const OptionClass<PlanOptions> options = [] {
    OptionClass<PlanOptions>::MoreNames more{{}, setLargeOption};
    for (const LargeOption& option : kLargeOptions) more.names.push_back(option.name);
    return OptionClass<PlanOptions>(planOptionTable(), more);
  }();
  return options;
}

}  // namespace kinegraph::python
