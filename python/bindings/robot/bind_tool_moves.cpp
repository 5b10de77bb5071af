#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <tuple>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/text.h"
#include "kinegraph/tool_paths/plan_tool_path.h"
#include "python_names.h"
#include "robot/robot_objects.h"
#include "robot/tool_moves_docs.h"
#include "tool_paths/tool_waypoint.h"

namespace kinegraph::python {

namespace {

using MaybeLimit = std::optional<Numbers>;

/// The docstring of a move of a frame from its first sentence and its own arguments.
std::string docOf(const char* summary, const char* arguments) {
  using namespace docs::robot;
  return cat(summary, moveAbout, moveFrame, arguments, moveOptions, moveReturns);
}

std::string docOfPath() {
  using namespace docs::robot;
  return cat(moveSequencePath, moveAbout, moveSequencePathArgs, moveOptions, moveSequencePathOptions, moveReturns);
}

/// Types of arguments.
template <class... Types>
struct Arguments {};

/// Binds a method that moves a tool: arguments of its own, those that all of them have, and more of its own by keyword.
/// `move` is called without the interpreter lock.
template <class... Own, class... More, class Move, class... OwnNames, class... MoreNames>
void bindToolMove(nb::class_<PyBotOp>& bot, const char* name, const std::string& doc, Arguments<Own...>,
                  const std::tuple<OwnNames...>& own_names, Arguments<More...>,
                  const std::tuple<MoreNames...>& more_names, Move move) {
  const auto function = [name, move](PyBotOp& self, Own... own, double speed, double tolerance,
                                     double rotation_tolerance, double margin, const std::vector<std::string>& touching,
                                     const MaybeLimit& velocity, const MaybeLimit& acceleration, const MaybeLimit& jerk,
                                     double tool_acceleration, double tool_jerk,
                                     const std::optional<double>& time_limit, bool overwrite, More... more) {
    ToolPathOptions options;
    options.speed = speed, options.tool_acceleration = tool_acceleration, options.tool_jerk = tool_jerk;
    options.tolerance = tolerance, options.rotation_tolerance = rotation_tolerance;
    options.margin = margin, options.touching = touching;
    if (velocity) options.velocity = velocity->values;
    if (acceleration) options.acceleration = acceleration->values;
    if (jerk) options.jerk = jerk->values;
    if (time_limit) options.time_limit = *time_limit;
    const ToolPathPlan plan = [&] {
      const nb::gil_scoped_release unlock;
      return move(*self, own..., more..., options, overwrite);
    }();
    if (!plan.feasible()) emitWarning(cat(name, ": there is no motion: ", inPython(plan.message)));
    return plan;
  };
  const auto shared = std::tuple(
      "tolerance"_a = ToolPathOptions().tolerance, "rotation_tolerance"_a = ToolPathOptions().rotation_tolerance,
      "margin"_a = 0., "touching"_a = std::vector<std::string>(), "velocity"_a = nb::none(),
      "acceleration"_a = nb::none(), "jerk"_a = nb::none(), "tool_acceleration"_a = ToolPathOptions().tool_acceleration,
      "tool_jerk"_a = ToolPathOptions().tool_jerk, "time_limit"_a = nb::none(), "overwrite"_a = false);
  std::apply(
      [&](const auto&... names) { bot.def(name, function, names..., doc.c_str()); },
      std::tuple_cat(own_names, std::tuple("speed"_a = ToolPathOptions().speed, nb::kw_only()), shared, more_names));
}

}  // namespace

void bindToolMoves(nb::class_<PyBotOp>& bot) {
  using Name = const std::string&;
  using Pose = const Numbers&;
  bindToolMove(bot, "moveLinear", docOf(docs::robot::moveLinear, docs::robot::moveLinearArgs), Arguments<Name, Pose>(),
               std::tuple("frame"_a, "target"_a), Arguments<>(), std::tuple(),
               [](BotOp& b, Name frame, Pose target, const ToolPathOptions& options, bool overwrite) {
                 return b.moveLinear(frame, waypointOf("moveLinear", target.values), options, overwrite);
               });
  bindToolMove(bot, "moveCircular", docOf(docs::robot::moveCircular, docs::robot::moveCircularArgs),
               Arguments<Name, Pose, Pose>(), std::tuple("frame"_a, "via"_a, "target"_a), Arguments<>(), std::tuple(),
               [](BotOp& b, Name frame, Pose via, Pose target, const ToolPathOptions& options, bool overwrite) {
                 return b.moveCircular(frame, waypointOf("moveCircular", via.values).p,
                                       waypointOf("moveCircular", target.values), options, overwrite);
               });
  bindToolMove(bot, "moveSequence", docOf(docs::robot::moveSequence, docs::robot::moveSequenceArgs),
               Arguments<Name, const std::vector<Numbers>&, double>(),
               std::tuple("frame"_a, "targets"_a, "blend"_a = 0.), Arguments<>(), std::tuple(),
               [](BotOp& b, Name frame, const std::vector<Numbers>& targets, double blend,
                  const ToolPathOptions& options, bool overwrite) {
                 std::vector<ToolWaypoint> waypoints;
                 for (const Numbers& target : targets) waypoints.push_back(waypointOf("moveSequence", target.values));
                 return b.moveSequence(frame, waypoints, blend, options, overwrite);
               });
  bindToolMove(bot, "moveSequence", docOfPath(), Arguments<const ToolPath&>(), std::tuple("path"_a),
               Arguments<double, double, Name>(),
               std::tuple("approach"_a = 0., "retract"_a = 0., "flow"_a = "approach"),
               [](BotOp& b, const ToolPath& path, double approach, double retract, Name flow, ToolPathOptions options,
                  bool overwrite) {
                 options.approach = approach, options.retract = retract, options.flow = transferFlowOfName(flow);
                 return b.moveSequence(path, options, overwrite);
               });
}

}  // namespace kinegraph::python
