#include "kinegraph/task_planning/lgp/lgp_actions.h"

#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline task_planning_internal {

namespace {

using F = FeatureSymbol;
using O = ObjectiveType;
using Tamp = DefaultLgpAbstraction;
using M = ManipulationHelper;

constexpr double kInside = .02;  ///< m: distance of a gripper from the sides of a box

/// The name of a frame that an action adds.
std::string frameName(const char* kind, const std::string& parent, const std::string& obj, double time) {
  return cat(kind, "_", parent, "_", obj, "_", std::lround(time));
}

void pickFrame(Tamp& tamp, M& m, double time, const std::string& hand, const std::string& obj) {
  const std::string name = frameName("pickPose", hand, obj, time);
  m.add_stable_frame(JointType::free, hand, name);
  tamp.switchTo(m, time, name, obj);
}

/// (pick_touch obj from hand), (handover obj hand to): the hand that holds it afterwards touches it.
void pickTouch(Tamp& tamp, M& m, double time, const TaskAction& action) {
  const std::string &obj = action[1], &hand = action[3];
  pickFrame(tamp, m, time, hand, obj);
  m.komo->addObjective({time}, F::distance, {obj, hand}, O::eq, 1e2);
}

std::string palmOf(const std::string& hand) {
  constexpr std::string_view kGripper = "gripper";
  return (hand.ends_with(kGripper) ? hand.substr(0, hand.size() - kGripper.size()) : hand) + "palm";
}

/// (pick_box obj from hand): the fingers close along the y axis of a box, close to its center.
void pickBox(Tamp& tamp, M& m, double time, const TaskAction& action) {
  const std::string &obj = action[1], &hand = action[3];
  const std::vector<double> size = tamp.C.getFrame(obj).getSize();
  if (size.size() < 3) throw ValueError(cat("pick_box: '", obj, "' is no box; expected sizes x, y and z"));
  pickFrame(tamp, m, time, hand, obj);
  const std::vector<std::string> frames = {hand, obj};
  const Vector3d inside = .5 * Vector3d(size[0], size[1], size[2]) - Vector3d::Constant(kInside);
  const MatrixXd rows = (MatrixXd(2, 3) << 1e1, 0., 0., 0., 0., 1e1).finished();
  m.komo->addObjective({time}, F::positionRel, frames, O::eq, {0., 1e1, 0.});
  m.komo->addObjective({time}, F::positionRel, frames, O::ineq, rows, inside);
  m.komo->addObjective({time}, F::positionRel, frames, O::ineq, -rows, -inside);
  for (const F product : {F::scalarProductXX, F::scalarProductXZ})
    m.komo->addObjective({time - .2, time}, product, frames, O::eq, 1.);
  m.komo->addObjective({time - .3, time}, F::distance, {palmOf(hand), obj}, O::ineq, 1e1, -.001);
  m.komo->addObjective({time}, F::distance, {obj, hand}, O::ineq, -1e1);
}

/// (place_straightOn obj hand to): the object stands there, with its center within the edges.
void placeStraightOn(Tamp& tamp, M& m, double time, const TaskAction& action) {
  const std::string &obj = action[1], &to = action[3];
  const std::string name = frameName("placePose", to, obj, time);
  m.add_place_frame(to, obj, name);
  tamp.switchTo(m, time, name, obj);
}

/// (place_box obj hand to): the x axis of the box is up.
void placeBox(Tamp& tamp, M& m, double time, const TaskAction& action) {
  const std::string &obj = action[1], &hand = action[2], &to = action[3];
  if (!tamp.is_last(time)) {
    const std::string name = frameName("placePose", to, obj, time);
    m.add_stable_frame(JointType::free, to, name);
    tamp.switchTo(m, time, name, obj);
  }
  m.place_box(time, obj, to, palmOf(hand), "x");
  m.komo->addObjective({time}, F::distance, {obj, hand}, O::ineq, -1e1);
}

/// (poseEq obj goal)
void poseEqual(Tamp&, M& m, double time, const TaskAction& action) {
  m.komo->addObjective({time}, F::poseDiff, {action[1], action[2]}, O::eq, 1e1);
}

/// (gripper_push obj floor hand): pushes until the end of the next action.
void gripperPush(Tamp& tamp, M& m, double time, const TaskAction& action) {
  const std::string &obj = action[1], &floor = action[2], &hand = action[3];
  if (tamp.is_last(time)) return;  // a push without a destination
  const std::string name = frameName("pushPose", hand, obj, time);
  m.add_stable_frame(JointType::free, hand, name, obj);
  tamp.switchTo(m, time, name, obj);
  if (tamp.steps(*m.komo) > 1) m.komo->addObjective({time}, F::poseDiff, {name, obj}, O::eq, 1.);
  m.straight_push({time, time + 1.}, obj, hand, floor, 1., frameName("_straight_pushStart", hand, obj, time));
}

/// (end_push hand obj floor to)
void endPush(Tamp& tamp, M& m, double time, const TaskAction& action) {
  if (!tamp.is_last(time)) throw ValueError("end_push is the last action of a plan; another one follows");
  m.place_box(time, action[2], action[4], "", "z");
}

struct LgpAction {
  const char* name;
  std::size_t words;
  void (*add)(Tamp&, M&, double, const TaskAction&);
};

constexpr LgpAction kActions[] = {
    {"pick_touch", 4, pickTouch},     {"pick_box", 4, pickBox},
    {"handover", 4, pickTouch},       {"place_straightOn", 4, placeStraightOn},
    {"place_box", 4, placeBox},       {"poseEq", 3, poseEqual},
    {"gripper_push", 4, gripperPush}, {"end_push", 5, endPush},
    {"pick", 4, pickTouch},           {"place", 4, placeStraightOn},  // names in older files
};

}  // namespace

void addLgpAction(DefaultLgpAbstraction& tamp, ManipulationHelper& m, double time, const TaskAction& action) {
  std::vector<std::string> known;
  for (const LgpAction& one : kActions) {
    known.push_back(one.name);
    if (action.empty() || action[0] != one.name) continue;
    if (action.size() < one.words) {
      throw ValueError(cat("action ", planText({action}), " has ", action.size(), " words; expected ", one.words));
    }
    return one.add(tamp, m, time, action);
  }
  throw ValueError(cat("unknown action '", action.empty() ? "" : action[0], "'; known are ", join(known, ", "),
                       "; others need a subclass"));
}

}  // namespace kinegraph::inline task_planning_internal
