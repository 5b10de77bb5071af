#include "kinegraph/task_planning/task_actions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/grasps.h"
#include "kinegraph/task_planning/placements.h"
#include "kinegraph/task_planning/shape_points.h"
#include "kinegraph/task_planning/task_tools.h"
#include "kinegraph/task_planning/task_waypoints.h"

namespace kinegraph {

namespace {

using F = FeatureSymbol;
using O = ObjectiveType;
using Variants = std::vector<std::string>;

constexpr double kInsideHandle = .02;        ///< m: the same for handles
constexpr double kHookGap = 5e-4;            ///< m: between a hook and the object at the begin of a pull
constexpr double kAbove = .003;              ///< m: clearance of a pulling tool from the ground
constexpr double kPlay = .002;               ///< m: by which the lowest tool may be higher
constexpr double kSafe = .5;                 ///< share of the height at which the pulled object tips
constexpr std::size_t kCombinations = 4096;  ///< of variants that are ranked at most

void take(TaskWaypoints& w, double time, const TaskAction& action, const std::string& variant) {
  w.attach(time, action[3], action[1]);
  addGrasp(w, time, action[3], action[1], variant);
}

void place(TaskWaypoints& w, double time, const TaskAction& action, const std::string& variant) {
  if (variant == "upright" || variant == kAsItLies)
    w.put(time, action[1], action[3]);
  else
    w.lay(time, action[1], action[3], variant);
}

void holdAt(TaskWaypoints& w, double time, const TaskAction& action, const std::string&) {
  w.komo().addObjective({time}, F::poseDiff, {action[1], action[3]}, O::eq, 1e1);
}

void touch(TaskWaypoints& w, double time, const TaskAction& action, const std::string&) {
  w.attach(time, action[3], action[1], true, action[0] == "hook_start" ? kHookGap : 0.);
}

/// A bar presses with an upright face, so low that the pulled object does not tip. The tool lies flat, a little above
/// the ground.
void layFlat(TaskWaypoints& w, double time, const TaskAction& action, const std::string& variant) {
  const Frame obj = w.C.getFrame(action[1]), place = w.C.getFrame(action[2]), bar = w.C.getFrame(action[3]),
              tool = w.C.getFrame(action[4]);
  const int along = longAxis(bar), up = flatAxis(bar, tool);
  constexpr std::array kAxes = {F::vectorX, F::vectorY, F::vectorZ};
  const MatrixXd height = Eigen::RowVector3d(0., 0., 1e1);
  w.komo().addObjective({time}, kAxes[std::size_t(3 - along - up)], {action[3]}, O::eq, .1 * height);
  const Eigen::AlignedBox3d around = boxAround(obj);
  const Vector3d sides = around.sizes();
  const double depth = variant == "x" ? sides.x() : variant == "y" ? sides.y() : std::min(sides.x(), sides.y());
  const double lowest = .5 * bar.getSize()[std::size_t(up)] + kAbove + kPlay;
  const double most = around.min().z() + std::max(lowest, kSafe * tippingHeight(obj, place, depth));
  w.komo().addObjective({time}, F::positionDiff, {action[3], action[1]}, O::ineq, height, {0., 0., most});
  for (const Frame& part : shapesOf(tool))
    w.komo().addObjective({time}, F::distance, {part.getName(), action[2]}, O::ineq, 1e1, -kAbove);
}

/// The bar of a hook lies along a side of a box, across the axis of the variant, so that the box does not rotate during
/// the pull.
void hookOn(TaskWaypoints& w, double time, const TaskAction& action, const std::string& variant) {
  touch(w, time, action, variant);
  const int bar = longAxis(w.C.getFrame(action[3]));
  if (bar < 0) return;
  layFlat(w, time, action, variant);
  if (variant == "touch") return;
  constexpr std::array kProducts = {std::array{F::scalarProductXX, F::scalarProductXY},
                                    std::array{F::scalarProductYX, F::scalarProductYY},
                                    std::array{F::scalarProductZX, F::scalarProductZY}};
  const F across = kProducts[std::size_t(bar)][variant == "x" ? 0 : 1];
  w.komo().addObjective({time}, across, {action[3], action[1]}, O::eq, 1e0);
}

/// The sides of a box, first the one along which a pull brings it closer to the hand.
Variants hooksOf(const Config& C, const TaskAction& action) {
  const Frame obj = C.getFrame(action[1]);
  if (!isBox(obj) || longAxis(C.getFrame(action[3])) < 0) return {"touch"};
  const Vector3d way = C.getFrame(action[5]).getPosition() - obj.getPosition();
  const Matrix3d R = obj.getRotationMatrix();
  if (std::abs(R.col(0).dot(way)) >= std::abs(R.col(1).dot(way))) return {"x", "y", "touch"};
  return {"y", "x", "touch"};
}

void push(TaskWaypoints& w, double time, const TaskAction& action, const std::string&) {
  int begun = int(std::lround(time)) - 2;
  const auto begins = [&](const TaskAction& a) { return startsSliding(a) && a[1] == action[1]; };
  while (begun >= 0 && !begins(w.actions[std::size_t(begun)])) --begun;
  if (begun < 0) throw ValueError(cat("planTask: the push of '", action[1], "' ends and did not begin"));
  w.push(double(begun + 1), time, action[2], action[1], action[3]);
}

void hold(TaskWaypoints& w, double time, const TaskAction& action, const std::string& variant) {
  addGrasp(w, time, action[3], action[2], variant, kInsideHandle);
}

void guide(TaskWaypoints& w, double time, const TaskAction& action, const std::string& variant) {
  w.guide(time, action[1], action[2], action[3], variant == "open");
}

Variants holdsOf(const Config& C, const TaskAction& action) { return graspVariants(C, action[2], action[3]); }

Variants graspsOf(const Config& C, const TaskAction& action) { return graspVariants(C, action[1], action[3]); }

/// A box lies on any of its faces.
Variants faceOf(const Config& C, const TaskAction& action) {
  return isBox(C.getFrame(action[1])) ? Variants{action[4]} : Variants{};
}

/// An object that lies on its side stays so if it can.
Variants standsOf(const Config& C, const TaskAction& action) {
  if (restingRotation(C.getFrame(action[1])).isIdentity(0.)) return {"upright"};
  return {kAsItLies, "upright"};
}

auto only(const char* variant) {
  return [variant](const Config&, const TaskAction&) { return Variants{variant}; };
}

}  // namespace

TaskRules defaultTaskRules(bool is_upright) {
  TaskRules rules = {
      {"pick", {take, graspsOf}},
      {"lift", {take, graspsOf}},
      {"place", {place, standsOf}},
      {"lay", {place, faceOf}},
      {"push_start", {touch, only("touch")}},
      {"push_end", {push, only("push")}},
      {"hook_start", {hookOn, hooksOf}},
      {"hook_end", {push, only("push")}},
      {"hold", {hold, holdsOf}},
      {"open", {guide, only("open")}},
      {"close", {guide, only("close")}},
      {"pose", {holdAt, only("held")}},
      {"handover", {take, graspsOf}},
  };
  if (is_upright) rules["place"].variants = only("upright");
  return rules;
}

std::vector<Variants> allVariants(const Config& C, const std::vector<TaskAction>& actions, const TaskRules& rules,
                                  std::size_t most) {
  std::vector<Variants> lists;
  for (const TaskAction& action : actions) {
    const auto rule = rules.find(action[0]);
    if (rule == rules.end()) throw NameError(cat("planTask: there is no rule for the action ", action[0]));
    lists.push_back(rule->second.variants(C, action));
    if (lists.back().empty()) return {};
  }
  // Enumerates combinations like the digits of a number, then sorts them by the sum of their ranks.
  using Choice = std::pair<std::size_t, std::vector<std::size_t>>;
  std::vector<Choice> ranked;
  std::vector<std::size_t> choice(lists.size(), 0);
  for (bool more = true; more && ranked.size() < kCombinations;) {
    std::size_t sum = 0;
    for (const std::size_t k : choice) sum += k;
    ranked.emplace_back(sum, choice);
    more = false;
    for (std::size_t i = lists.size(); i-- > 0 && !more;) {
      more = ++choice[i] < lists[i].size();
      if (!more) choice[i] = 0;
    }
  }
  std::ranges::sort(ranked);
  std::vector<Variants> all;
  for (const Choice& one : ranked) {
    if (all.size() == most) break;
    Variants& ways = all.emplace_back();
    for (std::size_t i = 0; i < lists.size(); ++i) ways.push_back(lists[i][one.second[i]]);
  }
  return all;
}

}  // namespace kinegraph
