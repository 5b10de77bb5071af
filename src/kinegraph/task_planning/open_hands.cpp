#include "kinegraph/task_planning/open_hands.h"

#include <algorithm>
#include <array>
#include <vector>

#include "kinegraph/scene/hand_fingers.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph {

namespace {

constexpr double kNewOverlap = 1e-3;                ///< m: overlaps up to this depth do not count
constexpr std::array kShares = {1., .75, .5, .25};  ///< of the opening, in the order in which they are tried

/// The joint of the fingers of a hand, and all joints that move with it.
struct Fingers {
  FrameData* joint = nullptr;
  std::vector<Frame> moved;
};

Fingers fingersOf(const Config& C, const std::string& hand) {
  FrameData* head = &C.getFrame(hand).data();
  while (!head->joint && head->parent) head = head->parent;
  Fingers fingers;
  const std::vector<Frame> below = Frame(C.scene(), *head).getSubtree();
  for (const Frame& frame : below) {
    const auto& joint = frame.data().joint;
    if (!joint || joint->active || joint->mimic || joint->dofs() != 1 || joint->lower.size() != 1) continue;
    Fingers found{&frame.data(), {}};
    for (const Frame& other : below)
      if (other.data().moves() && &dofSource(other.data()) == found.joint) found.moved.push_back(other);
    if (found.moved.size() > 1) return found;
  }
  return fingers;
}

void setFingers(Config& C, const Fingers& fingers, double q) {
  C.setJointState(VectorXd::Constant(1, q), {fingers.joint->name});
}

}  // namespace

Config withOpenHands(const Config& C) {
  Config scene = C;
  const std::vector<HandFingers> openings = handFingersOf(C);
  for (const std::string& hand : wordsOf(taskFacts(C), "is_gripper")) {
    const Fingers fingers = fingersOf(scene, hand);
    if (!fingers.joint) continue;
    const double now = fingers.joint->joint->q[0];
    const double lower = fingers.joint->joint->lower[0], upper = fingers.joint->joint->upper[0];
    const auto opening = std::ranges::find(openings, fingers.joint->name, &HandFingers::joint);
    if (opening == openings.end()) continue;
    const double open = opening->widthAt(upper) > opening->widthAt(lower) ? upper : lower;
    const std::size_t overlaps = scene.getCollisions(-kNewOverlap).size();
    for (const double share : kShares) {
      setFingers(scene, fingers, now + share * (open - now));
      if (scene.getCollisions(-kNewOverlap).size() <= overlaps) break;
      setFingers(scene, fingers, now);
    }
  }
  return scene;
}

}  // namespace kinegraph
