#include "kinegraph/task_planning/task_waypoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/mode_switches.h"
#include "kinegraph/komo/path/mode.h"
#include "kinegraph/task_planning/grasps.h"
#include "kinegraph/task_planning/pull_start.h"
#include "kinegraph/task_planning/shape_points.h"
#include "kinegraph/task_planning/task_doors.h"
#include "kinegraph/task_planning/task_tools.h"
#include "kinegraph/task_planning/waypoint_slot.h"

namespace kinegraph {

namespace {

using F = FeatureSymbol;
using O = ObjectiveType;

constexpr double kGap = .02;     ///< m: preferred distance of objects on one place
constexpr double kBehind = .01;  ///< m: minimum distance of a pusher behind the center of an object
constexpr double kBeside = .5;   ///< share of half its height: maximum height of a pusher above its center
constexpr double kEdge = .01;    ///< m: distance of the center of a standing object from the edges
constexpr double kRim = 1e-3;    ///< m: distance of a whole footprint from the edges
constexpr double kWell = .5;  ///< share of the half sides of a place: an object that overhangs is closer to its middle
constexpr double kToTarget = 3., kToSpot = .3;  ///< scales, per m: of chosen positions on small and on large places
constexpr double kMoreMargin = 1.1;             ///< factor on the margin: waypoints have a little more than motions
constexpr double kApartScale = 1e2;             ///< per m, of missing margin
constexpr std::array kAcross = {F::scalarProductYX, F::scalarProductYY, F::scalarProductYZ};
constexpr std::array kAxes = {F::vectorX, F::vectorY, F::vectorZ};
constexpr double kLow = .005;    ///< m: height of a pulling bar above the ground
constexpr double kApart = .003;  ///< m: preferred clearance of a hand at a handle
constexpr double kNear = .3;     ///< scale of the objective that keeps a push close to a straight line of the joints
constexpr char kRoom[] = "room on ", kWeight[] = "weight of ";

/// The rotation in which an object is put down.
Matrix3d putRotation(const Frame& obj, const std::string& variant) {
  return variant == "upright" ? Matrix3d(Matrix3d::Identity()) : restingRotation(obj);
}

std::string cornerName(int number, const std::string& obj) { return cat("corner ", number, " of ", obj); }

std::vector<TaskAction> joined(std::vector<TaskAction> first, const std::vector<TaskAction>& then) {
  first.insert(first.end(), then.begin(), then.end());
  return first;
}

std::string roundText(double time) { return std::to_string(long(std::nearbyint(time))); }

/// Adds auxiliary frames to a scene: a large frame on each place for `lay`, because a free frame below it gets wide
/// limits; a frame at the center of mass of each placed object that is not at its origin; and frames at the corners of
/// the footprints of objects that are put down; and the frames by which hands hold low objects.
Config prepared(const Config& C, const std::vector<TaskAction>& actions, const std::vector<std::string>& variants) {
  if (variants.size() != actions.size())
    throw ValueError(
        cat("TaskWaypoints: ", variants.size(), " variants for ", actions.size(), " actions; expected one for each"));
  std::set<std::string> places;
  for (const TaskAction& action : actions) requireWords(action);
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const bool is_laid = std::ranges::find(otherFaces(), variants[i]) != otherFaces().end();
    if (isPlace(actions[i]) && is_laid) places.insert(actions[i][3]);
  }
  Config scene = C;
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const TaskAction& action = actions[i];
    if (isPick(action) || action[0] == "handover") addGripFrame(scene, action[3], action[1], variants[i]);
    if (action[0] != "place" && !endsSliding(action)) continue;
    const Matrix3d rotation = putRotation(scene.getFrame(action[1]), variants[i]);
    const Footprint footprint = footprintOf(scene.getFrame(action[1]), rotation);
    if (footprint.is_round || scene.findFrame(cornerName(0, action[1]))) continue;
    for (int k = 0; k < 4; ++k) {
      const Vector3d corner((k & 1 ? footprint.high : footprint.low).x(), (k & 2 ? footprint.high : footprint.low).y(),
                            0.);
      scene.addFrame(cornerName(k, action[1]), action[1]).setRelativePosition(rotation.transpose() * corner);
    }
  }
  for (const TaskAction& action : actions) {
    if (!isPlace(action) || scene.findFrame(kWeight + action[1])) continue;
    const Vector3d center = centerOfBody(scene.getFrame(action[1]));
    if (!isCentered(center)) scene.addFrame(kWeight + action[1], action[1]).setRelativePosition(center);
  }
  for (const std::string& place : places) {
    const double side = placeSides(scene.getFrame(place)).maxCoeff() + 1.;
    scene.addFrame(kRoom + place, place)
        .setShape(ShapeType::box, {side, side, side})
        .setColor({1., 1., 1., 0.})
        .setContact(0);
  }
  return scene;
}

double thicknessOf(const Frame& box) {
  const std::vector<double> size = box.getSize();
  return *std::min_element(size.begin(), size.begin() + 3);
}

bool isOn(const Frame& obj, const Frame& place) {
  const std::optional<Frame> below = obj.getParent();
  return below && *below == place;
}

}  // namespace

TaskWaypoints::TaskWaypoints(const Config& config, std::vector<TaskAction> words, std::vector<std::string> ways,
                             std::shared_ptr<ManipulationHelper> helper, double clearance,
                             const std::vector<TaskAction>& later)
    : m(helper ? std::move(helper) : std::make_shared<ManipulationHelper>()),
      C(prepared(config, words, ways)),
      actions(std::move(words)),
      variants(std::move(ways)),
      margin(clearance),
      doors_(doorsOf(C)),
      placements_(placementsOf(config, joined(actions, later), variants)) {
  m->setup_sequence(C, double(actions.size()), 1e-2, 1e-2);
  if (margin > 0.)
    komo().addObjective({}, F::accumulatedCollisions, {}, O::sos, kApartScale, {}, -1, kMoreMargin * margin);
  keepDoors();
  std::vector<std::string> hands;
  for (const std::size_t place : {3, 2})
    for (const TaskAction& action : actions)
      if (action.size() > place) hands.push_back(action[place]);
  for (const TaskAction& action : actions) {
    if (action.size() < 2 || !config.findFrame(action[1])) continue;
    if (const std::string hand = holderOf(config, action[1], hands); !hand.empty()) held_[action[1]] = hand;
  }
}

TaskWaypoints::~TaskWaypoints() = default;

void TaskWaypoints::addActions(const TaskRules& rules) {
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const auto rule = rules.find(actions[i][0]);
    if (rule == rules.end()) throw NameError(cat("TaskWaypoints: there is no rule for the action ", actions[i][0]));
    rule->second.add(*this, double(i + 1), actions[i], variants[i]);
  }
}

/// Fixes doors except in actions that move them.
void TaskWaypoints::keepDoors() {
  for (std::size_t i = 0; i < actions.size(); ++i)
    for (const TaskDoor& door : doors_)
      if (!isGuided(actions[i]) || objectOf(actions[i]) != door.name)
        komo().addObjective({double(i + 1)}, F::qItself, {door.name}, O::eq, 1e2, {}, 1);
}

void TaskWaypoints::guide(double time, const std::string& name, const std::string& handle, const std::string& hand,
                          bool opens) {
  const auto door = std::ranges::find(doors_, name, &TaskDoor::name);
  if (door == doors_.end())
    throw ValueError(cat("planTask: '", name,
                         "' is no door; expected a frame that is called is_door or is_drawer, with a ",
                         "joint of one dof that has limits"));
  const auto bound = [&](double share, bool is_most) {  // the sign depends on the direction from closed to open
    const double sign = (is_most ? 1e1 : -1e1) / (door->open - door->closed);
    komo().addObjective({time}, F::qItself, {name}, O::ineq, sign, VectorXd::Constant(1, door->at(share)));
  };
  if (opens) {
    bound(kOpenLeast, false);
    bound(kOpenMost, true);
  } else {
    const VectorXd shut = VectorXd::Constant(1, door->at(kClose));
    komo().addObjective({time}, F::qItself, {name}, O::eq, 1e2, shut);
  }
  const std::vector<std::string> parts = partsOf(C, name);
  for (const auto& [place, objects] : beside_) {  // prefers placed objects away from the motion
    if (std::ranges::find(parts, place) != parts.end()) continue;
    for (const std::string& obj : objects)
      for (const std::string& part : parts)
        if (C.getFrame(part).data().shape)
          komo().addObjective({time}, F::distance, {obj, part}, O::ineqP, 3e0, -2. * kGap);
  }
  komo().addControlObjective({time}, 1, kNear);
  // Motions begin without contact.
  komo().addObjective({time}, F::accumulatedCollisions, {}, O::sos, 1e2, {}, -1, kApart);
  const std::vector<std::string> pair = {hand, handle};
  switch (gripOf(C, hand, handle)) {
    case Grip::rigid:
      komo().addObjective({time}, F::poseRel, pair, O::eq, 1e1, {}, 1);
      break;
    case Grip::axis:
      komo().addObjective({time}, F::vectorZRel, {handle, hand}, O::eq, 1e1, {}, 1);
      [[fallthrough]];
    case Grip::point:
      komo().addObjective({time}, F::positionRel, pair, O::eq, 1e1, {}, 1);
  }
}

void TaskWaypoints::addSlot(SlotKind kind, const std::string& frame, int dofs, const std::string& face) {
  slots_.push_back({kind, slot_dofs_, frame, face});
  slot_dofs_ += dofs;
}

void TaskWaypoints::switchTo(double time, const std::string& frame, const std::string& obj) {
  komo().addRigidSwitch(time, frame, obj, false);
  const auto held = held_.find(obj);
  if (held == held_.end())
    komo().addObjective({time}, F::pose, {obj}, O::eq, 1e1, {}, 1);
  else
    komo().addObjective({time}, F::poseRel, {obj, held->second}, O::eq, 1e1, {}, 1);
  held_[obj] = frame;
}

void TaskWaypoints::attach(double time, const std::string& hand, const std::string& obj, bool touching, double gap) {
  const std::string name = cat("grasp_", hand, "_", obj, "_", roundText(time));
  m->add_stable_frame(JointType::free, hand, name);
  addSlot(SlotKind::grasp, name, 7);
  switchTo(time, name, obj);
  if (touching) komo().addObjective({time}, F::distance, {obj, hand}, O::eq, 1e1, -gap);
}

void TaskWaypoints::put(double time, const std::string& obj, const std::string& to) {
  const std::string name = cat("place_", to, "_", obj, "_", roundText(time));
  const std::size_t action = std::size_t(std::max(std::lround(time) - 1, 0L));
  const Matrix3d rotation = putRotation(C.getFrame(obj), action < variants.size() ? variants[action] : "");
  addSlot(SlotKind::place, name, 3);
  if (rotation.isIdentity(0.)) {
    m->add_place_frame(to, obj, name);
    switchTo(time, name, obj);
  } else {
    const double above = .5 * height(C.getFrame(to)) + depthBelow(C.getFrame(obj), rotation);
    const Pose on_top = C.getFrame(to).getPose() * Pose(Vector3d(0., 0., above), Quaterniond::Identity());
    const Pose as_it_lies = on_top * Pose(Vector3d::Zero(), Quaterniond(rotation));
    const std::string lying = cat(name, "_", kAsItLies);
    const JointType flat = JointType::transXYPhi, fixed_to = JointType::none;
    addFrameDof(komo().path(), {.name = name, .parent = to, .type = flat, .stable = true, .origin_pose = on_top});
    addFrameDof(komo().path(),
                {.name = lying, .parent = name, .type = fixed_to, .stable = true, .origin_pose = as_it_lies});
    switchTo(time, lying, obj);
  }
  const Placement* placement = nullptr;
  if (action < actions.size() && objectOf(actions[action]) == obj && placements_[action])
    placement = &*placements_[action];
  if (placement) slots_.back().placement = *placement;
  const Footprint footprint = footprintOf(C.getFrame(obj), rotation);
  const Eigen::Vector2d half = .5 * placeSides(C.getFrame(to));
  slots_.back().half = half;
  const bool is_whole =
      placement ? placement->is_whole : (half - Eigen::Vector2d::Constant(footprint.radius)).minCoeff() > kRim;
  const auto keepInside = [&](const std::string& what, const Eigen::Vector2d& room) {
    const MatrixXd rows = 1e1 * MatrixXd::Identity(2, 3);
    const Vector3d inside(room.x(), room.y(), 0.);
    komo().addObjective({time}, F::positionRel, {what, to}, O::ineq, rows, inside);
    komo().addObjective({time}, F::positionRel, {what, to}, O::ineq, -rows, -inside);
  };
  const Eigen::Array2d rim = half.array() - kEdge;
  if (is_whole && footprint.is_round) {
    keepInside(obj, half.array() - footprint.radius - kRim);
  } else if (is_whole) {
    for (int k = 0; k < 4; ++k) keepInside(cornerName(k, obj), half.array() - kRim);
  } else {
    const bool is_larger = (footprint.half() - half).maxCoeff() > -2. * kRim;
    keepInside(obj, is_larger ? (kWell * half.array()).eval() : rim.max(kWell * half.array()).eval());
  }
  if (C.findFrame(kWeight + obj)) keepInside(kWeight + obj, rim.max(kWell * half.array()));
  for (const std::string& other : beside_[to])  // prefers room for fingers
    komo().addObjective({time}, F::distance, {obj, other}, O::ineqP, 3e0, -kGap);
  beside_[to].push_back(obj);
  if (placement)
    komo().addObjective({time}, F::positionRel, {obj, to}, O::sos,
                        (placement->is_near ? kToSpot : kToTarget) * MatrixXd::Identity(2, 3),
                        {placement->at.x(), placement->at.y(), 0.});
}

void TaskWaypoints::lay(double time, const std::string& obj, const std::string& to, const std::string& face) {
  const std::string name = cat("place_", to, "_", obj, "_", roundText(time));
  m->add_stable_frame(JointType::free, kRoom + to, name);
  addSlot(SlotKind::lay, name, 7, face);
  switchTo(time, name, obj);
  const double least = placeSides(C.getFrame(to)).minCoeff();
  const Vector3d sizes = boxAround(C.getFrame(obj)).sizes();
  const int up = int(std::string_view("xyz").find(face.empty() ? '?' : face[0]));
  double radius = 0.;  // of the face below
  for (int k = 0; k < 3; ++k)
    if (k != up) radius = std::hypot(radius, .5 * sizes[k]);
  const bool has_room = radius + kRim < .5 * least;
  m->place_box(time, obj, to, "", face, has_room ? radius + kRim : std::min(kEdge, .25 * least));
}

void TaskWaypoints::push(double start, double end, const std::string& pusher, const std::string& obj,
                         const std::string& to) {
  const std::string helper = cat("push_", pusher, "_", obj, "_", roundText(end));
  m->add_stable_frame(JointType::hingeZ, obj, helper);
  addSlot(SlotKind::push, helper, 1);
  put(end, obj, to);
  komo().addObjective({end}, F::AlignYWithDiff, {helper, obj}, O::eq, 1e0, {}, 1);
  komo().addObjective({end}, F::quaternion, {obj}, O::eq, 1e1, {}, 1);
  const auto row = [](double x, double y, double z) { return MatrixXd(Eigen::RowVector3d(x, y, z)); };
  const double height = boxAround(C.getFrame(obj)).max().z();
  komo().addObjective({start}, F::positionRel, {pusher, helper}, O::eq, row(1e1, 0., 0.));
  komo().addObjective({start}, F::positionRel, {pusher, helper}, O::ineq, row(0., 1e1, 0.), {0., -kBehind, 0.});
  komo().addObjective({start}, F::positionRel, {pusher, helper}, O::ineq, row(0., 0., 1e1), {0., 0., kBeside * height});
  if (const int across = longAxis(C.getFrame(pusher)); across >= 0) {  // a bar is level, across the line, and low
    komo().addObjective({start}, kAcross[std::size_t(across)], {helper, pusher}, O::eq, 1e0);
    komo().addControlObjective({end}, 1, kNear);
    if (isOn(C.getFrame(obj), C.getFrame(to)))  // short, but not zero
      komo().addObjective(
          {end}, F::position, {obj}, O::sos, kNear,
          usualPull(C, actions.at(std::size_t(std::lround(end)) - 1), variants.at(std::size_t(std::lround(start)) - 1)),
          1);
    komo().addObjective({start}, kAxes[std::size_t(across)], {pusher}, O::eq, row(0., 0., 1e0));
    const double low = kLow - height + .5 * thicknessOf(C.getFrame(pusher));
    komo().addObjective({start}, F::positionRel, {pusher, helper}, O::sos, row(0., 0., 3e0), {0., 0., low});
  }
}

std::shared_ptr<TaskWaypoints> makeTaskWaypoints(const Config& C, std::vector<TaskAction> actions,
                                                 std::vector<std::string> variants, const TaskRules& rules,
                                                 std::shared_ptr<ManipulationHelper> helper, double margin,
                                                 const std::vector<TaskAction>& later) {
  const auto waypoints =
      std::make_shared<TaskWaypoints>(C, std::move(actions), std::move(variants), std::move(helper), margin, later);
  waypoints->addActions(rules);
  return waypoints;
}

}  // namespace kinegraph
