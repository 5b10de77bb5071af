#include "kinegraph/tasks/task_waypoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/ik/solve_ik.h"
#include "kinegraph/tasks/shape_points.h"

namespace kinegraph {

namespace {

using F = FeatureSymbol;
using O = ObjectiveType;

constexpr double kGap = .02;     ///< m: how far things should stand apart that are put on the same place
constexpr double kBehind = .01;  ///< m: how far behind the middle of an object what pushes it is at least
constexpr double kBeside = .5;   ///< of half its height: how far above its middle at most
constexpr double kEdge = .01;    ///< m: how far inside of an edge the center of what stands there is
constexpr double kTurn = 1.6;    ///< rad: starts of placements are turned by up to that
constexpr std::array kAcross = {F::scalarProductYX, F::scalarProductYY, F::scalarProductYZ};
constexpr std::array kAxes = {F::vectorX, F::vectorY, F::vectorZ};
constexpr double kLow = .005;        ///< m: above the ground, where a bar pulls without tipping
constexpr double kApart = .003;      ///< m: that a hand with a handle keeps from all else, if it can
constexpr double kNear = .3;         ///< scale of joint motions that a straight line of the joints is to come near to
constexpr double kHookBehind = .06;  ///< m: how far behind what it pulls a hook starts
constexpr char kRoom[] = "room on ";

std::string roundText(double time) { return std::to_string(long(std::nearbyint(time))); }

/// A scene; where something is laid on a place, with a large frame there: a free frame below it has wide limits.
Config withRoom(const Config& C, const std::vector<TaskAction>& actions, const std::vector<std::string>& variants) {
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
  for (const std::string& place : places) {
    const double side = placeSides(scene.getFrame(place)).maxCoeff() + 1.;
    scene.addFrame(kRoom + place, place)
        .setShape(ShapeType::box, {side, side, side})
        .setColor({1., 1., 1., 0.})
        .setContact(0);
  }
  return scene;
}

Vector4d turnAbout(const Vector3d& axis, double angle) {
  Vector4d q;
  q << std::cos(.5 * angle), std::sin(.5 * angle) * axis;
  return q;
}

/// The shortest turn that brings an axis of an object up.
Vector4d upright(const Vector3d& axis) {
  if (axis.z() < -1. + 1e-12) return turnAbout(axis.cross(Vector3d::UnitY()), std::numbers::pi);
  Vector4d q;
  q << 1. + axis.z(), axis.cross(Vector3d::UnitZ());
  return q / std::sqrt(q.squaredNorm());
}

double thicknessOf(const Frame& box) {
  const std::vector<double> size = box.getSize();
  return *std::min_element(size.begin(), size.begin() + 3);
}

/// The quaternion that turns an axis of an object up, then about that by an angle.
Vector4d turned(const std::string& face, double about) {
  const int k = int(std::string_view("xyz").find(face[0]));
  const Vector4d q = turnAbout(Vector3d::UnitZ(), about),
                 r = upright((face.ends_with("Neg") ? -1. : 1.) * Vector3d::Unit(k));
  const Vector3d v = q.tail<3>(), b = r.tail<3>();
  Vector4d product;
  product << q[0] * r[0] - v.dot(b), q[0] * b + r[0] * v + v.cross(b);
  return product;
}

/// Joints that bring a hand to a target, upright if that is possible; else as they are. Doors stay.
VectorXd near(const Config& C, const std::string& hand, const Vector3d& target, const VectorXd& q) {
  Config all = C;
  all.setJointState(q);
  const std::vector<TaskDoor> doors = doorsOf(all);
  const StillDoors still = withStillDoors(all, doors);
  IkOptions options;
  options.collisions = false;
  options.attempts = 10;
  const IkTarget there = IkTarget::toPosition(hand, target);
  const IkTarget up = IkTarget::toDirection(hand, Vector3d::UnitZ(), Vector3d::UnitZ());
  for (const std::vector<IkTarget>& wanted : {std::vector{there, up}, std::vector{there}}) {
    const IkResult result = solveIk(still.scene, wanted, options);
    if (!result.feasible()) continue;
    VectorXd found = q;
    found(still.dofs) = result.q;
    return found;
  }
  return q;
}

/// Joints somewhere within their limits, from which another way to reach a handle may be found. Doors stay.
VectorXd elsewhere(const Config& C, const VectorXd& q, Rng& rng) {
  Config scene = C;
  scene.setRandom(rng);
  VectorXd drawn = scene.getJointState();
  for (const TaskDoor& door : doorsOf(C)) drawn[door.dof] = q[door.dof];
  return drawn;
}

/// The same for a hook, of a tool that the hand holds in its middle.
VectorXd nearWithTool(const Config& C, const TaskAction& action, const Vector3d& target, const VectorXd& q) {
  const std::string &hook = action[startsSliding(action) ? 3 : 2], &tool = action[4], &hand = action[5];
  Config scene = C;
  scene.getFrame(tool).setParent(scene.getFrame(hand)).setJoint(JointType::rigid);
  scene.getFrame(tool).setRelativePose(Pose());
  return near(scene, hook, target, q);
}

}  // namespace

TaskWaypoints::TaskWaypoints(const Config& config, std::vector<TaskAction> words, std::vector<std::string> ways,
                             std::shared_ptr<ManipulationHelper> helper)
    : m(helper ? std::move(helper) : std::make_shared<ManipulationHelper>()),
      C(withRoom(config, words, ways)),
      actions(std::move(words)),
      variants(std::move(ways)),
      doors_(doorsOf(C)) {
  m->setup_sequence(C, double(actions.size()), 1e-2, 1e-2);
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

void TaskWaypoints::addActions(const TaskRules& rules) {
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const auto rule = rules.find(actions[i][0]);
    if (rule == rules.end()) throw NameError(cat("TaskWaypoints: there is no rule for the action ", actions[i][0]));
    rule->second.add(*this, double(i + 1), actions[i], variants[i]);
  }
}

/// Doors stay where they are but where an action moves them.
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
  const auto bound = [&](double share, bool is_most) {  // the joint's sign is that of the way from closed to open
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
  for (const auto& [place, objects] : beside_) {  // what was put elsewhere had better be out of its way
    if (std::ranges::find(parts, place) != parts.end()) continue;
    for (const std::string& obj : objects)
      for (const std::string& part : parts)
        if (C.getFrame(part).data().shape)
          komo().addObjective({time}, F::distance, {obj, part}, O::ineqP, 3e0, -2. * kGap);
  }
  komo().addControlObjective({time}, 1, kNear);
  // Motions begin where nothing touches.
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

void TaskWaypoints::addSlot(Slot::Kind kind, const std::string& frame, int dofs, const std::string& face) {
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
  addSlot(Slot::Kind::grasp, name, 7);
  switchTo(time, name, obj);
  if (touching) komo().addObjective({time}, F::distance, {obj, hand}, O::eq, 1e1, -gap);
}

void TaskWaypoints::put(double time, const std::string& obj, const std::string& to) {
  const std::string name = cat("place_", to, "_", obj, "_", roundText(time));
  m->add_place_frame(to, obj, name);
  addSlot(Slot::Kind::place, name, 3);
  switchTo(time, name, obj);
  const Eigen::Vector2d half = .5 * placeSides(C.getFrame(to));
  const Vector3d inside(std::max(half.x() - kEdge, .5 * half.x()), std::max(half.y() - kEdge, .5 * half.y()), 0.);
  MatrixXd rows = MatrixXd::Zero(2, 3);
  rows(0, 0) = rows(1, 1) = 1e1;
  komo().addObjective({time}, F::positionRel, {obj, to}, O::ineq, rows, inside);
  komo().addObjective({time}, F::positionRel, {obj, to}, O::ineq, -rows, -inside);
  for (const std::string& other : beside_[to])  // room for fingers, where there is room
    komo().addObjective({time}, F::distance, {obj, other}, O::ineqP, 3e0, -kGap);
  beside_[to].push_back(obj);
  if (C.getFrame(to).getJointType() == JointType::rigid)  // on something small and loose the middle is safest
    komo().addObjective({time}, F::positionRel, {obj, to}, O::sos, .3 * rows);
}

void TaskWaypoints::lay(double time, const std::string& obj, const std::string& to, const std::string& face) {
  const std::string name = cat("place_", to, "_", obj, "_", roundText(time));
  m->add_stable_frame(JointType::free, kRoom + to, name);
  addSlot(Slot::Kind::lay, name, 7, face);
  switchTo(time, name, obj);
  m->place_box(time, obj, to, "", face, std::min(kEdge, .25 * placeSides(C.getFrame(to)).minCoeff()));
}

void TaskWaypoints::push(double start, double end, const std::string& pusher, const std::string& obj,
                         const std::string& to) {
  const std::string helper = cat("push_", pusher, "_", obj, "_", roundText(end));
  m->add_stable_frame(JointType::hingeZ, obj, helper);
  addSlot(Slot::Kind::push, helper, 1);
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
    komo().addObjective({start}, kAxes[std::size_t(across)], {pusher}, O::eq, row(0., 0., 1e0));
    const double low = kLow - height + .5 * thicknessOf(C.getFrame(pusher));
    komo().addObjective({start}, F::positionRel, {pusher, helper}, O::sos, row(0., 0., 3e0), {0., 0., low});
  }
}

/// Where a slot begins; of placements, the offset from the middle of the place.
Vector3d TaskWaypoints::startSlot(const Slot& slot, const Nlp& nlp, VectorXd& x, Rng* rng, bool grasps) const {
  const int first = slot.first;
  const auto draw = [&](double low, double high) { return rng ? rng->uniform(low, high) : 0.; };
  if (slot.kind == Slot::Kind::place) {
    for (int i = first; i < first + 2; ++i) x[i] = draw(.9 * nlp.lower()[i], .9 * nlp.upper()[i]);
    x[first + 2] = draw(-kTurn, kTurn);
  } else if (slot.kind == Slot::Kind::lay) {
    for (int i = first; i < first + 2; ++i) x[i] = draw(-.1, .1);
    x[first + 2] = .1;
    x.segment<4>(first + 3) = turned(slot.face, draw(-kTurn, kTurn));
  } else if (slot.kind == Slot::Kind::grasp) {
    x.segment<7>(first) << 0., 0., 0., 1., 0., 0., 0.;
    if (rng && grasps) {
      for (int i = first + 3; i < first + 7; ++i) x[i] = rng->normal();
      double squares = 0.;
      for (int i = first + 3; i < first + 7; ++i) squares += x[i] * x[i];
      x.segment<4>(first + 3) /= std::sqrt(squares);
    }
  }
  return {x[first], slot.kind == Slot::Kind::push ? 0. : x[first + 1], 0.};
}

VectorXd TaskWaypoints::start(Rng* rng, bool grasps) const {
  VectorXd x = m->komo->path().variables();
  const std::shared_ptr<Nlp> nlp = makeNlp(m->komo);
  std::map<std::string, Vector3d> offsets;
  for (const Slot& slot : slots_) {
    const Vector3d offset = startSlot(slot, *nlp, x, rng, grasps);
    if (slot.kind == Slot::Kind::place || slot.kind == Slot::Kind::lay) offsets[slot.frame] = offset;
  }
  VectorXd q = C.getJointState();
  const Eigen::Index n = q.size();
  std::map<std::string, Vector3d> at;
  for (const Frame& frame : C.getFrames()) at.emplace(frame.getName(), frame.getPosition());
  for (std::size_t i = 0; i < actions.size(); ++i) {
    if (isHold(actions[i]) && rng && grasps) q = elsewhere(C, q, *rng);
    q = startOf(i, q, at, offsets);
    x.segment(slot_dofs_ + Eigen::Index(i) * n, n) = q;
  }
  return x;
}

/// Joints after an action that begins at `before`, near what the hand does; and what it moves. `at`: where things are.
VectorXd TaskWaypoints::startOf(std::size_t i, const VectorXd& before, std::map<std::string, Vector3d>& at,
                                const std::map<std::string, Vector3d>& offsets) const {
  const TaskAction& action = actions[i];
  if (isPick(action) && at.contains(action[1])) return near(C, action[3], at.at(action[1]), before);
  if (isPlace(action)) {
    const auto offset = offsets.find(cat("place_", action[3], "_", action[1], "_", i + 1));
    Vector3d target = at.at(action[3]);
    if (offset != offsets.end()) target += offset->second;
    target.z() += .05;
    at[action[1]] = target;
    return near(C, action[2], target, before);
  }
  if (action[0] == "hook_start") {
    const auto end = std::find_if(actions.begin() + std::ptrdiff_t(i), actions.end(), endsSliding);
    Vector3d target = at.at(action[1]);
    if (end != actions.end()) {
      const Vector3d way = at.at((*end)[3]) - target;
      const double length = way.head<2>().norm();
      if (length > kGap) target.head<2>() -= kHookBehind / length * way.head<2>();
    }
    return nearWithTool(C, action, target, before);
  }
  if (action[0] == "hook_end") {
    at[action[1]] = at.at(action[3]);
    return nearWithTool(C, action, at.at(action[3]), before);
  }
  if (isHold(action)) return near(C, action[3], at.at(action[2]), before);
  const auto door = isGuided(action) ? std::ranges::find(doors_, action[1], &TaskDoor::name) : doors_.end();
  if (door == doors_.end()) return before;
  VectorXd q = before;
  q[door->dof] = door->at(action[0] == "open" ? .5 * (kOpenLeast + kOpenMost) : kClose);
  Config scene = C;
  scene.setJointState(q);
  for (const Frame& moved : scene.getFrame(action[1]).getSubtree()) at[moved.getName()] = moved.getPosition();
  return near(C, action[3], at.at(action[2]), q);
}

std::shared_ptr<TaskWaypoints> makeTaskWaypoints(const Config& C, std::vector<TaskAction> actions,
                                                 std::vector<std::string> variants, const TaskRules& rules,
                                                 std::shared_ptr<ManipulationHelper> helper) {
  const auto waypoints = std::make_shared<TaskWaypoints>(C, std::move(actions), std::move(variants), std::move(helper));
  waypoints->addActions(rules);
  return waypoints;
}

}  // namespace kinegraph
