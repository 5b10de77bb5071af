#include "kinegraph/task_planning/gripper_frames.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "kinegraph/common/text.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/scene/hand_fingers.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr double kAligned = .9;    ///< cosine of the angle between the x axis and the motion of the fingers
constexpr double kInside = 2e-3;   ///< m: a frame this deep in a shape lies inside of it
constexpr double kBackwards = .5;  ///< cosine of the angle between the z axis and the way from the fingers to the palm
constexpr double kShort = .01;     ///< m: a shorter way has no direction
constexpr double kNoPart = .01;    ///< smaller parts of a rotation axis are written as 0

const FrameData& headOf(const FrameData& frame) {
  const FrameData* head = &frame;
  while (!head->joint && head->parent) head = head->parent;
  return *head;
}

/// Returns the direction in the world in which the two sides of a hand begin to move apart, of unit length; zero if
/// unknown. Fingers that rotate far have another direction when they are wide open.
Vector3d motionOfFingers(const Config& C, const HandFingers& fingers) {
  if (fingers.pads.empty() || fingers.q.size() < 2) return Vector3d::Zero();
  Config scene = C;
  const Eigen::Index last = fingers.q.size() - 1, step = std::max<Eigen::Index>(last / 4, 1);
  const bool grows = fingers.widths[last] > fingers.widths[0];
  const Eigen::Index narrow = grows ? 0 : last, wider = grows ? step : last - step;
  std::map<const FrameData*, std::pair<int, Vector3d>> sides;  // number of shapes, sum of the motions of their centers
  for (const bool opens : {false, true}) {
    scene.setJointState(VectorXd::Constant(1, fingers.q[opens ? wider : narrow]), {fingers.joint});
    const State& state = scene.scene()->state();
    for (const std::string& name : fingers.pads) {
      const FrameData& pad = *scene.scene()->find(name);
      auto& [count, motion] = sides.try_emplace(&headOf(pad), 0, Vector3d::Zero()).first->second;
      const Vector3d center = state.pose(pad.id) * pad.shape->body()->boundCenter();
      motion += opens ? center : Vector3d(-center);
      count += opens;
    }
  }
  if (sides.size() != 2) return Vector3d::Zero();
  const auto& first = sides.begin()->second;
  const auto& second = std::next(sides.begin())->second;
  const Vector3d apart = first.second / first.first - second.second / second.first;
  return apart.norm() > 1e-6 ? Vector3d(apart.normalized()) : Vector3d(Vector3d::Zero());
}

bool isBelow(const FrameData& frame, const FrameData& head) {
  for (const FrameData* up = &frame; up; up = up->parent)
    if (up == &head) return true;
  return false;
}

double rounded(double x) { return std::abs(x) < kNoPart ? 0. : std::round(1e3 * x) / 1e3; }

/// Returns what is wrong with the x axis, and the rotation of the frame that mends it: the smallest.
std::string flawOfAxes(const Pose& X, const FrameData& hand, const Vector3d& axis) {
  Vector3d local = X.q.conjugate() * axis;
  if (std::abs(local[0]) > kAligned) return "";
  // Of the two directions of the fingers, the nearer one, or that of a turn about +y or +z.
  const bool is_across = std::abs(local[0]) < 1e-6, is_along_z = std::abs(local[1]) < 1e-6;
  if (is_across ? (is_along_z ? local[2] > 0. : local[1] < 0.) : local[0] < 0.) local = -local;
  const Vector3d about = Vector3d::UnitX().cross(local).normalized();
  const double degrees = std::round(std::acos(std::clamp(local[0], -1., 1.)) * 180. / std::numbers::pi);
  const auto named = [&] {
    for (int k = 0; k < 3; ++k)
      if (std::abs(local[k]) > kAligned) return cat("along its ", "xyz"[k], " axis");
    return cat("along (", rounded(local[0]), " ", rounded(local[1]), " ", rounded(local[2]), ") in its axes");
  };
  return cat("the x axis of '", hand.name, "' is not the direction of its fingers, which move ", named(),
             ", so grasps will miss; append d(", degrees, " ", rounded(about[0]), " ", rounded(about[1]), " ",
             rounded(about[2]), ") to its Q");
}

/// The mean of the centers of shapes in the world; none without a shape.
template <class Selects>
std::optional<Vector3d> middleOf(const SceneTree& scene, const State& state, const Selects& selects) {
  Vector3d sum = Vector3d::Zero();
  int count = 0;
  for (const auto& frame : scene.frames()) {
    if (!frame->shape || shapeKind(frame->shape->geometry->type).is_symbol || !selects(*frame)) continue;
    sum += state.pose(frame->id) * frame->shape->body()->boundCenter();
    ++count;
  }
  return count > 0 ? std::optional<Vector3d>(sum / count) : std::nullopt;
}

/// Returns what is wrong with the z axis, which points from the fingers to the palm, and the rotation that mends it.
std::string flawOfDirection(SceneTree& scene, const State& state, const FrameData& hand, const HandFingers& fingers) {
  if (!headOf(hand).joint) return "";  // all that stands in the world would be its palm
  const auto isPad = [&](const FrameData& frame) { return std::ranges::count(fingers.pads, frame.name) > 0; };
  const auto tips = middleOf(scene, state, isPad);
  const auto palm = middleOf(scene, state, [&](const FrameData& frame) { return &headOf(frame) == &headOf(hand); });
  if (!tips || !palm) return "";
  Vector3d back = scene.worldPose(hand).q.conjugate() * Vector3d(*palm - *tips);
  back[0] = 0.;
  if (back.norm() < kShort || back[2] > kBackwards * back.norm()) return "";
  constexpr double kQuarter = 90.;
  const double degrees = kQuarter * std::round(std::atan2(-back[1], back[2]) * 180. / std::numbers::pi / kQuarter);
  return cat("the z axis of '", hand.name,
             "' does not point from the fingers back into the hand, so low objects are "
             "missed; append d(",
             std::abs(degrees) > 179. ? 180. : degrees, " 1 0 0) to its Q");
}

/// Returns in which shape of the hand the frame lies, the deepest.
std::string flawOfPlace(const SceneTree& scene, const State& state, const FrameData& hand) {
  const RigidTransform X = state.pose(hand.id);
  const FrameData* around = nullptr;
  double deepest = kInside;
  for (const auto& frame : scene.frames()) {
    if (!frame->shape || frame->shape->contact == 0 || &headOf(*frame) != &headOf(hand)) continue;
    if (shapeKind(frame->shape->geometry->type).is_symbol || frame.get() == &hand) continue;
    const double depth = -proximity(*pointBody(), X, *frame->shape->body(), state.pose(frame->id)).distance;
    if (depth <= deepest) continue;
    deepest = depth;
    around = frame.get();
  }
  if (!around) return "";
  return cat("'", hand.name, "' lies ", fixed(1e3 * deepest, 0), " mm inside '", around->name,
             "'; its place is between the fingertips");
}

}  // namespace

std::vector<std::string> gripperFrameFlaws(const Config& C, const std::vector<std::string>& hands) {
  std::vector<std::string> flaws;
  const std::vector<HandFingers> all = handFingersOf(C);
  SceneTree& scene = *C.scene();
  for (const std::string& name : hands) {
    const FrameData& hand = *scene.find(name);
    std::vector<HandFingers> own;
    std::ranges::copy_if(all, std::back_inserter(own),
                         [&](const HandFingers& f) { return isBelow(*scene.find(f.joint), headOf(hand)); });
    const Vector3d axis = own.size() == 1 ? motionOfFingers(C, own[0]) : Vector3d(Vector3d::Zero());
    std::string of_axes = axis.isZero(0.) ? "" : flawOfAxes(scene.worldPose(hand), hand, axis);
    if (of_axes.empty() && own.size() == 1) of_axes = flawOfDirection(scene, scene.state(), hand, own[0]);
    if (!of_axes.empty()) flaws.push_back(std::move(of_axes));
    if (std::string flaw = flawOfPlace(scene, scene.state(), hand); !flaw.empty()) flaws.push_back(std::move(flaw));
  }
  return flaws;
}

}  // namespace kinegraph::inline task_planning_internal
