#include "kinegraph/task_planning/search/poor_placements.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/placements.h"
#include "kinegraph/task_planning/shape_points.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph::inline task_planning_internal {

namespace {

using Eigen::Vector2d;

constexpr double kRoomAround = .004;  ///< m: between footprints, and in all at the edges
constexpr double kBesides = .02;      ///< m: to an object that stands on a place already

/// The sides of a footprint along the axes of a place, as it is or rotated by 90 degrees.
std::vector<Vector2d> sidesOf(const Frame& obj) {
  const Footprint footprint = footprintOf(obj);
  const Vector2d sides = 2. * (footprint.is_round ? Vector2d::Constant(footprint.radius).eval() : footprint.half());
  return {sides, {sides.y(), sides.x()}};
}

bool fits(const Vector2d& sides, const Vector2d& place) { return (sides.array() + kRoomAround <= place.array()).all(); }

bool fits(const Frame& obj, const Vector2d& place) {
  return std::ranges::any_of(sidesOf(obj), [&](const Vector2d& sides) { return fits(sides, place); });
}

bool fitBoth(const Frame& a, const Frame& b, const Vector2d& place) {
  for (const Vector2d& one : sidesOf(a))
    for (const Vector2d& other : sidesOf(b)) {
      const Vector2d sum = one + other + Vector2d::Constant(kRoomAround), most = one.cwiseMax(other);
      if (fits({sum.x(), most.y()}, place) || fits({most.x(), sum.y()}, place)) return true;
    }
  return false;
}

/// Whether an object fits on one of the four sides of another one that stands on a place.
bool fitsBeside(const Frame& obj, const Frame& other, const Frame& place) {
  const RigidTransform X = place.getPose().inverse().transform();
  Eigen::AlignedBox2d around;
  for (const Frame& part : shapesOf(other))
    for (const Eigen::Vector3d& corner : boxCorners(part))
      around.extend(Vector2d((X * (part.getPose().transform() * corner)).head<2>()));
  const Vector2d sides = placeSides(place), apart = Vector2d::Constant(kBesides);
  const Vector2d below = around.min() + .5 * sides - apart, above = .5 * sides - around.max() - apart;
  for (const Vector2d& free : {below, above})
    if (fits(obj, {free.x(), sides.y()}) || fits(obj, {sides.x(), free.y()})) return true;
  return false;
}

}  // namespace

std::vector<ImpossibleAction> poorPlacements(const Config& C, const std::vector<TaskAction>& actions,
                                             const std::vector<Literal>& start, const std::vector<Literal>& goal) {
  std::map<std::string, std::set<std::string>> onto;
  for (const TaskAction& action : actions)
    if (action[0] == "place") onto[action[3]].insert(action[1]);
  std::vector<ImpossibleAction> poor;
  const std::vector<std::string> all = wordsOf(start, "is_object"), carriers = wordsOf(start, "is_carrier");
  const auto isOneOf = [](const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  };
  for (const TaskAction& action : actions) {
    if (action[0] != "place" || !isOneOf(all, action[3]) || isOneOf(carriers, action[3])) continue;
    if (!contains(goal, {"on", {action[3], action[1]}}))
      poor.push_back({action, {}, cat("the goal does not want '", action[1], "' on '", action[3], "'")});
  }
  for (const auto& [name, objects] : onto) {
    const Frame place = C.getFrame(name);
    if (!hasTop(place)) continue;
    const Vector2d sides = placeSides(place);
    const auto isWanted = [&](const std::string& obj) { return contains(goal, {"on", {name, obj}}); };
    std::vector<std::string> whole;
    for (const std::string& obj : objects)
      if (obj != name && fits(C.getFrame(obj), sides)) whole.push_back(obj);
    for (const std::string& a : whole)
      for (const std::string& b : whole) {
        if (a == b || (isWanted(a) && isWanted(b))) continue;
        const Frame one = C.getFrame(a), other = C.getFrame(b);
        if (contains(start, {"on", {name, b}}) ? fitsBeside(one, other, place) : fitBoth(one, other, sides)) continue;
        for (const TaskAction& action : actions)
          if (action[0] == "place" && action[1] == a && action[3] == name)
            poor.push_back({action, {Literal{"on", {name, b}}}, cat("'", name, "' has no room for both")});
      }
  }
  return poor;
}

}  // namespace kinegraph::inline task_planning_internal
