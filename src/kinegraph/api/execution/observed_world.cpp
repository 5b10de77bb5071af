#include "kinegraph/api/execution/observed_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "kinegraph/api/execution/standing_sides.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/cells.h"
#include "kinegraph/logic/domain.h"
#include "kinegraph/robot/scene_grippers.h"
#include "kinegraph/scene/collisions.h"
#include "kinegraph/simulation/scene_bodies.h"
#include "kinegraph/task_planning/motions/motion_checks.h"
#include "kinegraph/task_planning/task_doors.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph {

namespace {

using Words = std::vector<std::string>;

double cosineOfDegrees(double degrees) { return std::cos(degrees * std::numbers::pi / 180.); }

constexpr double kSlipped = .02;                 ///< m: tolerance of held objects in the hand
constexpr double kOff = .03;                     ///< m: tolerance of standing objects
constexpr double kNearOff = .008;                ///< m: tolerance of objects and places that come next
const double kNearTurned = cosineOfDegrees(4.);  ///< tolerance of the rotation of objects that come next
constexpr double kLeastLever = .01;              ///< m: of objects that slipped because they turned
constexpr double kCloser = .8;                   ///< factor on levers that another grasp may have
constexpr double kTouch = 5e-3;                  ///< m: objects that are closer touch
constexpr double kRest = .1, kStill = 1e-3;      ///< s, m: objects that move less in this time are at rest
constexpr int kMostRests = 30;                   ///< such times, at most, until objects are at rest
constexpr double kJointOff = .05;                ///< rad or m: tolerance of joints
constexpr double kBeyond = 1e-3;                 ///< rad or m: joints that are not farther beyond a limit are at it

/// Returns the place that an object stands on: the nearest of those that it touches and whose center is lower; "" if
/// none.
std::string placeBelow(const Config& C, const std::string& obj, const Words& places) {
  const double height = C.getFrame(obj).getPosition().z();
  double nearest = std::numeric_limits<double>::infinity();
  std::string below;
  for (const std::string& place : places) {
    if (place == obj || !(C.getFrame(place).getPosition().z() < height)) continue;
    const double gap = std::abs(standingGap(C, obj, place));
    if (gap < nearest || (gap == nearest && place < below)) nearest = gap, below = place;
  }
  return nearest <= kTouch ? below : "";
}

/// Gives a scene the cells of another one, as obstacles. Returns the sides of single cells by the ids of frames, m.
std::map<int, double> copyCells(const Config& from, Config& to) {
  std::map<int, double> sides;
  for (const Frame& cells : from.getFrames()) {
    if (cells.getShapeType() != kCells || cells.data().shape->contact == 0) continue;
    const Geometry& geometry = *cells.data().shape->geometry;
    const std::string& name = cells.getName();
    Frame copy = to.findFrame(name) ? to.getFrame(name) : to.addFrame(name);
    setCells(copy, *geometry.grid, {geometry.size[0], geometry.size[1], geometry.size[2]});
    copy.setPose(cells.getPose());
    copy.setContact(1);
    sides[copy.id()] = geometry.size[0] / geometry.grid->cells[0];
  }
  return sides;
}

Frame rootOf(const Config& C, const std::string& name) {
  Frame frame = C.getFrame(name);
  while (const std::optional<Frame> parent = frame.getParent()) frame = *parent;
  return frame;
}

bool isBelow(const Config& C, const std::string& name, const std::string& ancestor) {
  std::optional<Frame> frame = C.findFrame(name);
  while (frame && frame->getName() != ancestor) frame = frame->getParent();
  return frame.has_value();
}

void requireMovableObject(const std::string& obj, const Words& doors, const Config& world) {
  if (!(world.getFrame(obj).getMass() > 0.))
    throw ValueError(cat("execute: '", obj,
                         "' has no mass, so that it stays where it is in the simulated world; call "
                         "C.getFrame('",
                         obj, "').setMass(...) before BotOp(C)"));
  for (const std::string& door : doors) {
    if (isBelow(world, obj, door))
      throw ValueError(cat("execute: '", obj, "' hangs below '", door,
                           "', so that it is a part of it in the simulated world; call C.getFrame('", obj,
                           "').unLink() before BotOp(C)"));
  }
}

/// Throws ValueError if joints of q move the fingers of a hand.
void requireFingersOutsideQ(const std::string& hand, const Config& world) {
  const Frame head = headOfLink(world.getFrame(hand));
  Words fingers, others = world.getJointNames();
  for (const Frame& frame : head.getSubtree()) {
    const auto& joint = frame.data().joint;
    if (!(frame == head) && joint && joint->active && joint->dofs() > 0) fingers.push_back(frame.getName());
  }
  if (fingers.empty()) return;
  std::erase_if(others, [&](const std::string& name) { return std::ranges::find(fingers, name) != fingers.end(); });
  throw ValueError(cat("execute: the fingers of '", hand, "' (", join(fingers),
                       ") are joints of q, so that no gripper closes them; keep them out of q before planTask: "
                       "C.selectJoints({",
                       join(others), "}), or 'joint_active: false' in a file"));
}

}  // namespace

void api_internal::requireMovable(const TaskPlan& plan, const Config& world) {
  const Words objects = wordsOf(plan.start, "is_object"), doors = wordsOf(plan.start, "is_guided");
  for (const TaskAction& action : plan.actions) {
    const std::string obj = objectOf(action);
    if (std::ranges::find(objects, obj) != objects.end()) requireMovableObject(obj, doors, world);
    if (isGuided(action) && !attributeFlag(world.getFrame(obj).data(), "noMotor", false))
      throw ValueError(
          cat("execute: a motor moves '", obj,
              "' in the simulated world; set the attribute noMotor of its frame before BotOp(C), so that a "
              "hand can move it"));
  }
}

std::map<std::string, int> api_internal::grippersOf(const BotOp& bot, const Config& scene) {
  const std::vector<GripperInfo>& grippers = bot.getInfo().grippers;
  const std::vector<SceneGripper> hands = findGrippers(scene);  // a driver may have another name for a hand
  std::map<std::string, int> numbers;
  for (std::size_t i = 0; i < grippers.size(); ++i)
    numbers[hands.size() == grippers.size() ? hands[i].info.name : grippers[i].name] = int(i);
  return numbers;
}

void api_internal::requireGrippers(const TaskPlan& plan, const std::map<std::string, int>& grippers,
                                   const Config* simulated) {
  for (const TaskAction& action : plan.actions) {
    if (!(isPick(action) || isHold(action) || action[0] == "handover") || grippers.contains(action[3])) continue;
    if (simulated) {
      requireFingersOutsideQ(action[3], *simulated);
      continue;
    }
    Words names;
    for (const auto& [name, number] : grippers) names.push_back(name);
    throw ValueError(cat("execute: the plan closes '", action[3], "', and the robot's driver has ",
                         names.empty() ? std::string("no gripper") : cat("the grippers ", join(names, ", ")),
                         "; list its grippers in RobotInfo.grippers, in the order of the scene's hands"));
  }
}

double api_internal::plannedOpening(const TaskPlan& plan, int number, double most) {
  constexpr double kSame = 1e-3;  // m
  if (plan.scenes.empty()) return most;
  const Config& scene = plan.scenes.front();
  const std::vector<SceneGripper> hands = findGrippers(scene);
  if (number < 0 || std::size_t(number) >= hands.size()) return most;
  const HandFingers& fingers = hands[std::size_t(number)].opening;
  const double wide = fingers.widthAt(scene.getFrame(fingers.joint).data().joint->q[0]);
  return wide < fingers.maxWidth() - kSame ? std::min(wide, most) : most;
}

namespace {

/// Whether a plan added the frame for a grasp, a place or a push.
bool isSlot(const Frame& frame) {
  const std::string& name = frame.getName();
  const bool is_body = frame.getShapeType() != ShapeType::none && frame.getShapeType() != ShapeType::marker;
  return !is_body && (name.starts_with("grasp_") || name.starts_with("place_") || name.starts_with("push_"));
}

/// Deletes the frames of a plan's grasps, places and pushes to which nothing else is attached.
void deleteSlots(Config& C) {
  std::vector<std::string> slots;
  for (const Frame& frame : std::as_const(C).getFrames()) {
    if (isSlot(frame) && std::ranges::all_of(frame.getSubtree(), isSlot)) slots.push_back(frame.getName());
  }
  for (const std::string& name : slots) C.delFrame(name);
}

}  // namespace

Config worldOf(BotOp& bot, const TaskPlan& plan, bool is_observed) {
  plan.requireScenes("execute");
  if (is_observed && !plan.scenes.empty()) {
    Config believed = plan.scenes.front();
    deleteSlots(believed);
    return believed;
  }
  Config world = bot.getWorld();
  if (bot.isSimulated() || plan.scenes.empty()) return world;
  for (const std::string& obj : wordsOf(plan.start, "is_object")) {
    const std::optional<Frame> object = world.findFrame(obj);
    if (!object)
      throw ValueError(
          cat("execute: '", obj, "' is not in the scene of the robot; call bot.sync(C) with a scene that has it"));
    Frame(*object).setPose(plan.scenes.front().getFrame(obj).getPose());
  }
  return world;
}

ObservedWorld::ObservedWorld(BotOp& bot, Config& seen, std::function<ObservedPoses(Config&)> observe)
    : bot_(bot), seen_(seen), observe_(std::move(observe)), is_simulated_(bot.isSimulated()) {}

void ObservedWorld::setPlan(const TaskPlan& plan) {
  hands_ = wordsOf(plan.start, "is_gripper");
  objects_ = wordsOf(plan.start, "is_object");
  places_ = wordsOf(plan.start, "is_place");
  const Words names = seen_.getJointNames(), doors = wordsOf(plan.start, "is_guided");
  doors_.clear();
  driven_.clear();
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (std::ranges::find(doors, names[k]) != doors.end())
      doors_[names[k]] = Eigen::Index(k);
    else
      driven_.push_back(Eigen::Index(k));
  }
  held_.clear();
  for (const std::string& obj : objects_) {
    const std::string hand = plan.scenes.empty() ? "" : holderOf(plan.scenes[0], obj, hands_);
    const auto parent = plan.scenes.empty() ? std::nullopt : plan.scenes[0].getFrame(obj).getParent();
    const bool is_on_another = parent && std::ranges::find(objects_, parent->getName()) != objects_.end();
    if (!hand.empty() && !is_on_another) take(obj, hand);
  }
  if (!observe_ && is_simulated_) return;
  for (const std::string& obj : objects_) {
    if (believed_.contains(obj)) continue;
    believed_[obj] = held_.contains(obj) ? grips_.at(obj) : seen_.getFrame(obj).getPose();
  }
}

void ObservedWorld::advance(double seconds) {
  bot_.sync(seen_, seconds);
  placeBelieved();
}

void ObservedWorld::comeToRest() {
  const auto positions = [&] {
    std::vector<Vector3d> at;
    for (const std::string& obj : objects_) at.push_back(seen_.getFrame(obj).getPosition());
    return at;
  };
  for (int k = 0; k < kMostRests; ++k) {
    const std::vector<Vector3d> before = positions();
    advance(kRest);
    look();  // what cameras observe moves only then
    const std::vector<Vector3d> after = positions();
    double most = 0.;
    for (std::size_t i = 0; i < after.size(); ++i) most = std::max(most, (after[i] - before[i]).norm());
    if (most < kStill) return;
  }
}

void ObservedWorld::look() {
  bot_.sync(seen_, 0.);
  if (observe_) {
    placeBelieved();
    Config scene = this->scene();
    const ObservedPoses poses = observe_(scene);
    takeCells(scene);
    for (const auto& [name, pose] : poses) {
      seen_.getFrame(name);  // throws FrameNotFound
      if (!pose) continue;
      const auto held = held_.find(name);
      believed_[name] = held == held_.end() ? *pose : seen_.getFrame(held->second).getPose().inverse() * *pose;
    }
  }
  placeBelieved();
}

void ObservedWorld::takeCells(const Config& scene) { copyCells(scene, seen_); }

std::string ObservedWorld::blockedByCells(Config planned, const MatrixXd& path) const {
  const std::map<int, double> sides = copyCells(seen_, planned);
  if (sides.empty()) return "";
  for (const VectorXd& q : path.rowwise()) {
    planned.setJointState(q);
    for (const Config::NearPair& pair : planned.getCollisions()) {
      for (const auto& [map, other] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)}) {
        const auto side = sides.find(map);
        if (side != sides.end() && pair.distance < -.5 * side->second)
          return cat("'", planned.getFrame(other).getName(), "' would enter '", planned.getFrame(map).getName(),
                     "' by ", fixed(-pair.distance, 3), " m");
      }
    }
  }
  return "";
}

/// Moves objects that cameras observe to their last poses, or along with the hand.
void ObservedWorld::placeBelieved() {
  for (const auto& [obj, pose] : believed_) {
    const auto held = held_.find(obj);
    seen_.getFrame(obj).setPose(held == held_.end() ? pose : seen_.getFrame(held->second).getPose() * pose);
  }
}

void ObservedWorld::take(const std::string& obj, const std::string& hand) {
  const Pose grip = seen_.getFrame(hand).getPose().inverse() * seen_.getFrame(obj).getPose();
  held_[obj] = hand;
  grips_[obj] = grip;
  if (const auto believed = believed_.find(obj); believed != believed_.end()) believed->second = grip;
}

void ObservedWorld::release(const std::string& obj) {
  held_.erase(obj);
  if (const auto believed = believed_.find(obj); believed != believed_.end())
    believed->second = seen_.getFrame(obj).getPose();
}

bool ObservedWorld::touches(const std::string& hand, const std::string& obj) const {
  return handGap(seen_, obj, hand) <= kTouch;
}

double ObservedWorld::gripForce(const std::string& hand, const std::string& obj) const {
  const std::vector<Contact> contacts = bot_.getContacts();
  if (contacts.empty()) return std::numeric_limits<double>::infinity();
  std::optional<Frame> head = seen_.findFrame(hand);
  while (head && head->getJointType() == JointType::none && head->getParent()) head = head->getParent();
  double sum = 0.;
  for (const Contact& contact : contacts) {
    const bool is_first = isBelow(seen_, contact.frame_a, obj), is_second = isBelow(seen_, contact.frame_b, obj);
    if (is_first != is_second && isBelow(seen_, is_first ? contact.frame_b : contact.frame_a, head->getName()))
      sum += contact.force.norm();
  }
  return sum;
}

std::string ObservedWorld::slipped() const {
  for (const auto& [obj, hand] : held_) {
    const double off = slipOf(obj);
    if (off > kSlipped) return cat("'", obj, "' is not in '", hand, "': it is ", fixed(off, 3), " m off");
  }
  return "";
}

double ObservedWorld::slipOf(const std::string& obj) const {
  const Pose now = seen_.getFrame(held_.at(obj)).getPose().inverse() * seen_.getFrame(obj).getPose();
  return (now.p - grips_.at(obj).p).norm();
}

Words ObservedWorld::shortenLevers() {
  Words turned;
  for (const auto& [obj, hand] : held_) {
    if (slipOf(obj) <= kSlipped || !touches(hand, obj)) continue;
    Config taken = seen_;
    taken.getFrame(obj).setPose(seen_.getFrame(hand).getPose() * grips_.at(obj));
    const double lever = std::min(leverIn(taken.getFrame(hand), taken.getFrame(obj)), leverOf(taken.getFrame(obj)));
    const Node* said = seen_.getFrame(obj).attributes().find("lever");
    const double* before = said ? said->value.as<double>() : nullptr;
    if (lever < kLeastLever || (before && lever > kCloser * *before)) continue;  // another grasp would be no better
    seen_.getFrame(obj).editAttributes().set({"lever", {}, {}, {lever, {}}, {}});
    turned.push_back(obj);
  }
  return turned;
}

VectorXd ObservedWorld::jointErrors(const VectorXd& q) const { return (bot_.get_q() - q).cwiseAbs()(driven_); }

std::string ObservedWorld::deviation(Config planned, const VectorXd& q, const Words& near) const {
  planned.setJointState(q);
  Eigen::Index worst = 0;
  if (const double most = jointErrors(q).maxCoeff(&worst); most > kJointOff) {
    const std::string joint = planned.getJointNames()[std::size_t(driven_[std::size_t(worst)])];
    return cat("the robot is held up: joint '", joint, "' is ", fixed(most, 3), " off");
  }
  for (const auto& [door, dof] : doors_) {
    if (const double off = std::abs(seen_.getJointState()[dof] - q[dof]); off > kJointOff)
      return cat("'", door, "' is ", fixed(off, 3), " (m or rad) away from where it should be");
  }
  for (const std::string& obj : objects_)
    if (std::string failure = objectDeviation(obj, planned); !failure.empty()) return failure;
  for (const std::string& name : near) {
    const std::optional<Frame> is = seen_.findFrame(name), shall = planned.findFrame(name);
    if (!is || !shall || held_.contains(name)) continue;
    const double off = (is->getPosition() - shall->getPosition()).norm();
    if (off > kNearOff) return cat("'", name, "' is ", fixed(off, 3), " m away from where it should be");
    if (cosineBetween(*is, shall->getRotationMatrix()) < kNearTurned) return cat("'", name, "' has rotated");
  }
  return "";
}

std::string ObservedWorld::objectDeviation(const std::string& obj, const Config& planned) const {
  const Frame is = seen_.getFrame(obj), shall = planned.getFrame(obj);
  if (const auto held = held_.find(obj); held != held_.end()) {
    const std::string& hand = held->second;
    const Pose in_hand = seen_.getFrame(hand).getPose().inverse() * is.getPose();
    const Pose planned_in_hand = planned.getFrame(hand).getPose().inverse() * shall.getPose();
    const double off = (in_hand.p - planned_in_hand.p).norm();
    return off > kSlipped ? cat("'", obj, "' is not in '", hand, "': it is ", fixed(off, 3), " m off") : "";
  }
  const double off = (is.getPosition() - shall.getPosition()).norm();
  if (off > kOff) return cat("'", obj, "' is ", fixed(off, 3), " m away from where it should be");
  const Matrix3d rotation = shall.getRotationMatrix();
  const bool stands = hasSameSideUp(is, rotation) || leansInside(seen_, obj, placeBelow(seen_, obj, places_), rotation);
  return stands ? "" : cat("'", obj, "' has tilted");
}

std::vector<std::string> ObservedWorld::missedGoals(const std::vector<Literal>& goal, const Config& C) const {
  Words missed;
  for (const Literal& literal : goal) {
    if (literal.predicate != "on" || literal.arguments.size() != 2) continue;
    const std::string &place = literal.arguments[0], &obj = literal.arguments[1];
    const bool holds = std::ranges::any_of(obj == kAny ? objects_ : Words{obj}, [&](const std::string& name) {
      const std::optional<Frame> parent = C.getFrame(name).getParent();
      return parent && (place == kAny || parent->getName() == place);
    });
    if (holds == literal.negated) missed.push_back(literal.str());
  }
  const VectorXd q = seen_.getJointState();
  const std::vector<TaskDoor> doors = doorsOf(seen_);
  for (const Literal& literal : goal) {
    if ((literal.predicate != "opened" && literal.predicate != "closed") || literal.arguments.size() != 1) continue;
    const auto door = std::ranges::find(doors, literal.arguments[0], &TaskDoor::name);
    const bool holds = door != doors.end() && door->stateAt(q[door->dof]) == literal.predicate;
    if (holds == literal.negated) missed.push_back(literal.str());
  }
  return missed;
}

Config ObservedWorld::scene() const {
  Config C = seen_;
  const VectorXd q = C.getJointState();
  const MatrixXd limits = C.getJointLimits();
  const VectorXd inside = q.cwiseMax(limits.row(0).transpose()).cwiseMin(limits.row(1).transpose());
  if ((inside - q).cwiseAbs().maxCoeff() < kBeyond) C.setJointState(inside);  // a servo ends a little beyond a limit
  Words objects = objects_;
  std::ranges::sort(objects);
  std::ranges::stable_sort(objects, {}, [&](const std::string& obj) { return C.getFrame(obj).getPosition().z(); });
  std::map<std::string, std::string> below;  // the parents of before do not count
  for (const std::string& obj : objects) {
    const auto held = held_.find(obj);
    const bool is_held = held != held_.end() && touches(held->second, obj);
    below[obj] = is_held ? held->second : placeBelow(C, obj, places_);
    const std::optional<Frame> was = C.getFrame(obj).getParent();
    const bool was_on_another = was && std::ranges::find(objects_, was->getName()) != objects_.end();
    if (was && (was_on_another || !holderOf(C, obj, hands_).empty())) hang(C, obj, rootOf(C, obj).getName());
  }
  for (const std::string& obj : objects)
    if (!below[obj].empty()) hang(C, obj, below[obj]);
  return C;
}

}  // namespace kinegraph
