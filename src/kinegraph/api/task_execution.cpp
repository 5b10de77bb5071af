#include "kinegraph/api/task_execution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/simulation/scene_bodies.h"
#include "kinegraph/task_planning/search/motion_checks.h"
#include "kinegraph/task_planning/task_doors.h"

namespace kinegraph {

namespace {

using Words = std::vector<std::string>;

constexpr double kSlipped = .02;                                  ///< m: tolerance of held objects in the hand
constexpr double kOff = .03;                                      ///< m: tolerance of standing objects
const double kUpright = std::cos(10. * std::numbers::pi / 180.);  ///< objects that tilt more have fallen
constexpr double kEmpty = 2e-3;                                   ///< m: a gripper that is narrower holds nothing
constexpr double kTouch = 5e-3;                                   ///< m: objects that are closer touch
constexpr double kTimeout = 3., kQueryInterval = .05;             ///< s for a gripper, and between queries
constexpr double kComesToRest = .3;                               ///< s until objects are at rest
constexpr double kGripForce = 40.;                                ///< N
constexpr double kFar = .05;                                      ///< rad or m: tolerance of joints
constexpr double kOpenEnough = .9;                                ///< share of the widest opening
constexpr double kReverseSlowdown = 3.;                           ///< factor on the time of a motion for its reversal

Vector3d placeIn(const Config& C, const std::string& hand, const std::string& obj) {
  const Frame frame = C.getFrame(hand);
  return frame.getRotationMatrix().transpose() * (C.getFrame(obj).getPosition() - frame.getPosition());
}

bool isClear(Config& C, const VectorXd& q) {
  C.setJointState(q);
  return C.getCollisions(-kOverlap).empty();
}

/// Returns the place that an object stands on: the nearest of those that it touches and whose center is lower; "" if
/// none.
std::string placeBelow(const Config& C, const std::string& obj, const Words& places) {
  const double height = C.getFrame(obj).getPosition().z();
  double nearest = std::numeric_limits<double>::infinity();
  std::string below;
  for (const std::string& place : places) {
    if (place == obj || !(C.getFrame(place).getPosition().z() < height)) continue;
    const double gap = std::abs(gapOf(C, obj, place));
    if (gap < nearest || (gap == nearest && place < below)) nearest = gap, below = place;
  }
  return nearest <= kTouch ? below : "";
}

/// One execution: the observed world, and the objects in hands.
class Run {
 public:
  Run(const TaskPlan& plan, BotOp& bot, Config& seen)
      : plan_(plan),
        bot_(bot),
        seen_(seen),
        hands_(wordsOf(plan.start, "is_gripper")),
        objects_(wordsOf(plan.start, "is_object")),
        places_(wordsOf(plan.start, "is_place")) {
    const std::vector<GripperInfo>& grippers = bot.getInfo().grippers;
    for (std::size_t i = 0; i < grippers.size(); ++i) grippers_[grippers[i].name] = int(i);
    for (const std::string& obj : objects_) {
      const std::string hand = plan.scenes.empty() ? "" : holderOf(plan.scenes[0], obj, hands_);
      if (!hand.empty()) held_[obj] = hand;
    }
    const Words names = seen.getJointNames(), doors = wordsOf(plan.start, "is_guided");
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (std::ranges::find(doors, names[k]) != doors.end())
        doors_[names[k]] = Eigen::Index(k);
      else
        driven_.push_back(Eigen::Index(k));
    }
  }

  TaskExecution toTheEnd() {
    begin();
    for (std::size_t i = 0; i < plan_.actions.size(); ++i) {
      std::string failure = deviation(i, false);
      if (failure.empty()) {
        move(i);
        failure = deviation(i, true);
      }
      if (failure.empty()) failure = grip(plan_.actions[i]);
      if (failure.empty()) failure = deviation(i, true);
      if (failure.empty()) continue;
      backOut(i);
      return {false, cat(planText({plan_.actions[i]}), ": ", failure), int(i), scene()};
    }
    Config end = scene();
    const Words missed = missedGoals(end);
    const int count = int(plan_.actions.size());
    if (!missed.empty()) return {false, join(missed, ", ") + " does not hold", count, std::move(end)};
    return {true, "", count, std::move(end)};
  }

 private:
  void begin() {
    for (const TaskAction& action : plan_.actions) {
      const std::string obj = objectOf(action);
      const bool is_object = std::ranges::find(objects_, obj) != objects_.end();
      if (is_object) requireMovable(obj);
      if (isGuided(action) && !attributeFlag(seen_.getFrame(obj).data(), "noMotor", false))
        throw ValueError(
            cat("execute: a motor moves '", obj,
                "' in the simulated world; set the attribute noMotor of its frame before BotOp(C), so that a "
                "hand can move it"));
    }
    if (!plan_.actions.empty() && jointErrors(plan_.path.row(0)).maxCoeff() > kFar)
      throw ValueError(
          "execute: the robot is not where the plan begins; move it there first, or plan from its configuration");
    bot_.hold();
    for (const auto& [hand, number] : grippers_) {
      const bool holds = std::ranges::any_of(held_, [&](const auto& pair) { return pair.second == hand; });
      if (!holds && bot_.getGripperPos(number) < kOpenEnough * infoOf(number).max_width) open(hand);
    }
  }

  void requireMovable(const std::string& obj) const {
    if (!(seen_.getFrame(obj).getMass() > 0.))
      throw ValueError(cat("execute: '", obj,
                           "' has no mass, so that it stays where it is in the simulated world; call "
                           "C.getFrame('",
                           obj, "').setMass(...) before BotOp(C)"));
    for (const auto& [door, dof] : doors_) {
      for (const Frame& below : seen_.getFrame(door).getSubtree())
        if (below.getName() == obj)
          throw ValueError(cat("execute: '", obj, "' hangs below '", door,
                               "', so that it is a part of it in the simulated world; call C.getFrame('", obj,
                               "').unLink() before BotOp(C)"));
    }
  }

  const GripperInfo& infoOf(int number) const { return bot_.getInfo().grippers[std::size_t(number)]; }

  /// The deviation of each joint of the robot from q, without doors.
  VectorXd jointErrors(const VectorXd& q) { return (bot_.get_q() - q).cwiseAbs()(driven_); }

  MatrixXd pathOf(std::size_t i) const {
    return plan_.path.middleRows(plan_.segments[i].begin, plan_.segments[i].size());
  }
  VectorXd timesOf(std::size_t i) const {
    return plan_.times.segment(plan_.segments[i].begin, plan_.segments[i].size());
  }

  /// Executes the motion of an action.
  void move(std::size_t i) {
    const MatrixXd path = pathOf(i);
    const VectorXd times = timesOf(i);
    const Eigen::Index last = times.size() - 1;
    if (times[last] > times[0]) {
      bot_.move(path.bottomRows(last), VectorXd(times.tail(last).array() - times[0]));
      bot_.wait(seen_, false);
    }
    bot_.sync(seen_, kComesToRest);
  }

  /// After a failure: opens hands that have lost their objects, and reverses the motion until the robot is
  /// collision-free.
  void backOut(std::size_t i) {
    const std::map<std::string, std::string> held = held_, handles = handles_;
    for (const auto& [obj, hand] : held) {
      if (touches(hand, obj)) continue;
      held_.erase(obj);
      open(hand, obj);
    }
    for (const auto& [handle, hand] : handles) release(handle, hand);
    MatrixXd path = pathOf(i);
    const VectorXd times = timesOf(i), q = bot_.get_q();
    for (const auto& [door, dof] : doors_) path.col(dof).setConstant(q[dof]);
    const Eigen::Index last = path.rows() - 1;
    if (isGuided(plan_.actions[i]) || jointErrors(path.row(last)).maxCoeff() > kFar) return;
    Config C = scene();
    Eigen::Index free = last;
    while (free >= 0 && !isClear(C, path.row(free))) --free;
    if (free < 0 || free == last) return;
    const Eigen::Index count = last - free;
    bot_.move(path.middleRows(free, count).colwise().reverse(),
              VectorXd(kReverseSlowdown * (times[last] - times.segment(free, count).array()).reverse()));
    bot_.wait(seen_, false);
  }

  /// Closes or opens grippers for an action. Returns the failure, or "".
  std::string grip(const TaskAction& action) {
    const std::string& obj = action[1];
    std::string failure;
    if (isPick(action) || action[0] == "handover") {
      failure = close(action[3], obj);
      if (action[0] == "handover" && failure.empty()) open(action[2], obj);
      held_[obj] = action[3];
    } else if (isHold(action)) {
      handles_[action[2]] = action[3];
      failure = close(action[3], action[2]);
    } else if (isGuided(action)) {
      release(action[2], action[3]);
    } else if (isPlace(action)) {
      open(action[2], obj);
      held_.erase(obj);
    }
    bot_.sync(seen_, kComesToRest);
    return failure;
  }

  void release(const std::string& handle, const std::string& hand) {
    open(hand, handle);
    handles_.erase(handle);
  }

  std::string close(const std::string& hand, const std::string& obj) {
    const auto gripper = grippers_.find(hand);
    if (gripper == grippers_.end()) {
      bot_.attach(hand, obj);
      return "";
    }
    const int number = gripper->second;
    bot_.gripperCloseGrasp(number, obj, std::min(kGripForce, infoOf(number).max_force));
    waitFor(number);
    const bool is_empty = bot_.getGripperPos(number) < infoOf(number).min_width + kEmpty;
    return is_empty ? cat("'", hand, "' closed on nothing") : "";
  }

  void open(const std::string& hand, const std::string& obj = {}) {
    const auto gripper = grippers_.find(hand);
    if (gripper != grippers_.end()) {
      bot_.gripperMove(gripper->second, infoOf(gripper->second).max_width);
      waitFor(gripper->second);
    } else if (!obj.empty()) {
      bot_.detach(hand, obj);
    }
  }

  void waitFor(int gripper) {
    for (int k = 0; k < int(std::lround(kTimeout / kQueryInterval)); ++k) {
      bot_.sync(seen_, kQueryInterval);
      if (bot_.gripperDone(gripper)) return;
    }
  }

  /// Returns the first deviation from the plan at the beginning or the end of the motion of an action, or "".
  std::string deviation(std::size_t i, bool at_end) {
    Config planned = plan_.scenes[i];
    const RowRange& rows = plan_.segments[i];
    const VectorXd q = plan_.path.row(at_end ? rows.end - 1 : rows.begin);
    planned.setJointState(q);
    Eigen::Index worst = 0;
    if (const double most = jointErrors(q).maxCoeff(&worst); most > kFar) {
      const std::string joint = planned.getJointNames()[std::size_t(driven_[std::size_t(worst)])];
      return cat("the robot is held up: joint '", joint, "' is ", fixed(most, 3), " off");
    }
    for (const auto& [door, dof] : doors_) {
      if (const double off = std::abs(seen_.getJointState()[dof] - q[dof]); off > kFar)
        return cat("'", door, "' is ", fixed(off, 3), " (m or rad) away from where it should be");
    }
    for (const std::string& obj : objects_)
      if (std::string failure = objectDeviation(obj, planned); !failure.empty()) return failure;
    return "";
  }

  std::string objectDeviation(const std::string& obj, const Config& planned) const {
    if (const auto hand = held_.find(obj); hand != held_.end()) {
      const double off = (placeIn(seen_, hand->second, obj) - placeIn(planned, hand->second, obj)).norm();
      return off > kSlipped ? cat("'", obj, "' is not in '", hand->second, "': it is ", fixed(off, 3), " m off") : "";
    }
    const Frame is = seen_.getFrame(obj), shall = planned.getFrame(obj);
    const double off = (is.getPosition() - shall.getPosition()).norm();
    if (off > kOff) return cat("'", obj, "' is ", fixed(off, 3), " m away from where it should be");
    const bool is_level = is.getRotationMatrix().col(2).dot(shall.getRotationMatrix().col(2)) >= kUpright;
    return is_level ? "" : cat("'", obj, "' has tilted");
  }

  /// Returns the literals of the goal about places and doors that do not hold.
  Words missedGoals(const Config& C) const {
    Words missed;
    for (const Literal& literal : plan_.goal) {
      if (literal.predicate != "on" || literal.arguments.size() != 2) continue;
      const std::optional<Frame> parent = C.getFrame(literal.arguments[1]).getParent();
      if ((parent && parent->getName() == literal.arguments[0]) == literal.negated) missed.push_back(literal.str());
    }
    const VectorXd q = seen_.getJointState();
    const std::vector<TaskDoor> doors = doorsOf(seen_);
    for (const Literal& literal : plan_.goal) {
      if ((literal.predicate != "opened" && literal.predicate != "closed") || literal.arguments.size() != 1) continue;
      const auto door = std::ranges::find(doors, literal.arguments[0], &TaskDoor::name);
      const bool holds = door != doors.end() && door->stateAt(q[door->dof]) == literal.predicate;
      if (holds == literal.negated) missed.push_back(literal.str());
    }
    return missed;
  }

  bool touches(const std::string& hand, const std::string& obj) const { return gapOf(seen_, obj, hand) <= kTouch; }

  /// The observed world, with held objects attached to hands, and standing objects to their places.
  Config scene() const {
    Config C = seen_;
    for (const auto& [obj, hand] : held_)
      if (touches(hand, obj)) hang(C, obj, hand);
    Words objects = objects_;
    std::ranges::sort(objects);
    std::ranges::stable_sort(objects, {}, [&](const std::string& obj) { return C.getFrame(obj).getPosition().z(); });
    for (const std::string& obj : objects) {
      if (!holderOf(C, obj, hands_).empty()) continue;
      if (const std::string under = placeBelow(C, obj, places_); !under.empty()) hang(C, obj, under);
    }
    return C;
  }

  const TaskPlan& plan_;
  BotOp& bot_;
  Config& seen_;
  const Words hands_, objects_, places_;
  std::map<std::string, int> grippers_;         ///< indices by the names of hands
  std::map<std::string, std::string> held_;     ///< by object: the hand that holds it
  std::map<std::string, std::string> handles_;  ///< by handle: the hand that holds it
  std::map<std::string, Eigen::Index> doors_;   ///< indices of doors in q
  std::vector<Eigen::Index> driven_;            ///< indices of the other joints
};

}  // namespace

std::string TaskExecution::str() const {
  return cat(feasible ? "reached the goal" : "stopped", " after ", done, done == 1 ? " action" : " actions",
             feasible ? "" : ": ", message);
}

TaskExecution execute(const TaskPlan& plan, BotOp& bot, Config& seen) {
  plan.requireScenes("execute");
  return Run(plan, bot, seen).toTheEnd();
}

TaskExecution TaskPlan::execute(BotOp& bot) const {
  Config seen = bot.getWorld();
  return kinegraph::execute(*this, bot, seen);
}

}  // namespace kinegraph
