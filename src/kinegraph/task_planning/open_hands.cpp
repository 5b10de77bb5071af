#include "kinegraph/task_planning/open_hands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "kinegraph/scene/hand_fingers.h"
#include "kinegraph/task_planning/held_shapes.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr double kNewOverlap = 1e-3;                ///< m: overlaps up to this depth do not count
constexpr std::array kShares = {1., .75, .5, .25};  ///< of the opening, in the order in which they are tried

constexpr std::array kRooms = {.007, .0025};  ///< m: between an object and each finger of a hand that is narrower
constexpr double kNarrower = .95;             ///< share of the widest opening

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

/// The width of an object between the fingers of the hand that opens least for it, m; 0 if none takes it.
double leastWidth(const Config& C, const std::string& obj, const std::vector<std::string>& hands) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::string& hand : hands) {
    const std::vector<std::string> ways = graspVariants(C, obj, hand);
    if (ways.empty() || ways[0] == "touch") continue;
    const GraspWords words = graspWords(obj, ways[0]);
    const Vector3d sizes = heldShape(C, obj, words).box.sizes();
    least = std::min(least, words.axis() >= 0 ? sizes[words.axis()] : sizes.head<2>().minCoeff());
  }
  return std::isfinite(least) ? least : 0.;
}

/// The pairs of frames that overlap.
std::set<std::pair<int, int>> overlapsIn(const Config& C) {
  std::set<std::pair<int, int>> pairs;
  for (const Config::NearPair& pair : C.getCollisions(-kNewOverlap)) pairs.emplace(pair.a, pair.b);
  return pairs;
}

/// Whether no pair overlaps that did not overlap before.
bool overlapsNothingElse(const Config& C, const std::set<std::pair<int, int>>& before) {
  return std::ranges::includes(before, overlapsIn(C));
}

void setFingers(Config& C, const Fingers& fingers, double q) {
  C.setJointState(VectorXd::Constant(1, q), {fingers.joint->name});
}

}  // namespace

Config withOpenHands(const Config& C, double most) {
  Config scene = C;
  const std::vector<HandFingers> openings = handFingersOf(C);
  for (const std::string& hand : wordsOf(taskFacts(C), "is_gripper")) {
    const Fingers fingers = fingersOf(scene, hand);
    if (!fingers.joint) continue;
    const double now = fingers.joint->joint->q[0];
    const double lower = fingers.joint->joint->lower[0], upper = fingers.joint->joint->upper[0];
    const auto opening = std::ranges::find(openings, fingers.joint->name, &HandFingers::joint);
    if (opening == openings.end()) continue;
    const double wide = opening->widthAt(upper) > opening->widthAt(lower) ? upper : lower;
    const double open = opening->maxWidth() > most ? opening->positionAt(most) : wide;
    const std::set<std::pair<int, int>> overlaps = overlapsIn(scene);
    for (const double share : kShares) {
      setFingers(scene, fingers, now + share * (open - now));
      if (overlapsNothingElse(scene, overlaps)) break;
      setFingers(scene, fingers, now);
    }
  }
  return scene;
}

bool opensFreely(const Config& C, const std::string& hand, double width) {
  constexpr int kSteps = 8;
  Config scene = C;
  const Fingers fingers = fingersOf(scene, hand);
  if (!fingers.joint) return true;
  const std::vector<HandFingers> openings = handFingersOf(C);
  const auto opening = std::ranges::find(openings, fingers.joint->name, &HandFingers::joint);
  if (opening == openings.end()) return true;
  const double now = fingers.joint->joint->q[0], open = opening->positionAt(width);
  const std::set<std::pair<int, int>> overlaps = overlapsIn(scene);
  for (int k = 1; k <= kSteps; ++k) {
    setFingers(scene, fingers, now + double(k) / kSteps * (open - now));
    if (!overlapsNothingElse(scene, overlaps)) return false;
  }
  return true;
}

Config withFingersOf(const Config& C, const Config& other) {
  Config scene = C;
  for (const HandFingers& fingers : handFingersOf(C)) {
    const std::optional<Frame> same = other.findFrame(fingers.joint);
    if (!same || !same->data().joint || same->data().joint->q.size() != 1) continue;
    const FrameData& joint = scene.getFrame(fingers.joint).data();
    if (joint.joint->active) continue;
    scene.setJointState(VectorXd::Constant(1, same->data().joint->q[0]), {fingers.joint});
  }
  return scene;
}

std::vector<double> narrowerOpenings(const Config& C, const std::set<std::string>& objects) {
  const std::vector<HandFingers> all = handFingersOf(C);
  const std::vector<std::string> hands = wordsOf(taskFacts(C), "is_gripper");
  if (all.empty()) return {};
  const Config scene = withOpenings(C, hands);
  double needed = 0., widest = 0.;
  for (const HandFingers& fingers : all) widest = std::max(widest, fingers.maxWidth());
  for (const std::string& obj : wordsOf(taskFacts(C), "is_object"))
    if (objects.contains(obj) && scene.getFrame(obj).getShapeType() != ShapeType::none)
      needed = std::max(needed, leastWidth(scene, obj, hands));
  std::vector<double> openings;
  for (const double room : kRooms)
    if (needed > 0. && needed + 2. * room < kNarrower * widest) openings.push_back(needed + 2. * room);
  return openings;
}

}  // namespace kinegraph::inline task_planning_internal
