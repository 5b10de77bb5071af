#include "kinegraph/api/execution/standing_sides.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/held_shapes.h"
#include "kinegraph/task_planning/motions/motion_checks.h"
#include "kinegraph/task_planning/shape_points.h"
#include "kinegraph/task_planning/task_actions.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph::inline api_internal {

namespace {

const double kUpright = std::cos(10. * std::numbers::pi / 180.);  ///< objects that tilt more have fallen

constexpr double kUp = .9;  ///< cosine of the angle of an axis that counts as vertical

/// The axis that is nearest to the vertical, and whether it points up (1) or down (-1).
std::pair<Eigen::Index, double> upAxis(const Matrix3d& rotation) {
  Eigen::Index axis = 0;
  const Vector3d up = rotation.row(2);
  up.cwiseAbs().maxCoeff(&axis);
  return {axis, up[axis] < 0. ? -1. : 1.};
}

const double kLeaning = std::cos(45. * std::numbers::pi / 180.);  ///< objects that tilt more do not lean
constexpr double kLeanGap = 5e-3;                                 ///< m: bodies that are closer touch

/// Whether an object looks the same after any rotation about its axis.
bool isRound(const Frame& frame) {
  const ShapeType type = frame.getShapeType();
  return type == ShapeType::cylinder || type == ShapeType::ssCylinder || type == ShapeType::capsule;
}

/// The cosine of the angle between the directions that point up in two orientations. Lying round objects may roll.
double upCosine(const Frame& obj, const Matrix3d& rotation) {
  if (isBall(obj)) return 1.;
  const Vector3d now = obj.getRotationMatrix().row(2), then = rotation.row(2);
  const double round = now.z() * then.z() + now.head<2>().norm() * then.head<2>().norm();
  return isRound(obj) ? round : now.dot(then);
}

/// Whether a frame is fixed to another one above it.
bool isFixedTo(Frame frame, const Frame& above) {
  while (!(frame == above) && frame.getJointType() == JointType::none && frame.getParent()) frame = *frame.getParent();
  return frame == above;
}

/// Whether an object stands as in a rotation. One that was a little tilted may have settled on its side.
bool standsAs(const Frame& obj, const Matrix3d& rotation) {
  if (hasSameSideUp(obj, rotation)) return true;
  const auto [axis, sign] = upAxis(rotation);
  return sign * rotation(2, axis) > kUp && sign * obj.getRotationMatrix()(2, axis) >= kUpright;
}

}  // namespace

double cosineBetween(const Frame& obj, const Matrix3d& rotation) {
  if (isBall(obj)) return 1.;
  const Matrix3d R = obj.getRotationMatrix().transpose() * rotation;
  return isRound(obj) ? R(2, 2) : .5 * (R.trace() - 1.);
}

bool hasSameSideUp(const Frame& obj, const Matrix3d& rotation) { return upCosine(obj, rotation) >= kUpright; }

bool leansInside(const Config& C, const std::string& obj, const std::string& place, const Matrix3d& rotation) {
  const std::optional<Frame> below = C.findFrame(place);
  if (!below || !hasTop(*below) || upCosine(C.getFrame(obj), rotation) < kLeaning) return false;
  const double length = boxOfBody(C.getFrame(obj)).sizes().maxCoeff();
  if (placeSides(*below).maxCoeff() > length) return false;  // it leans on something, not in it
  return std::ranges::any_of(below->getSubtree(), [&](const Frame& wall) {
    const auto& shape = wall.data().shape;
    return !(wall == *below) && shape && shape->contact && isFixedTo(wall, *below) &&
           standingGap(C, obj, wall.getName()) < kLeanGap;
  });
}

void StandingSides::setPlan(const TaskPlan& plan) {
  if (plan.scenes.empty()) return;
  Config end = plan.scenes.back();
  end.setJointState(plan.path.row(plan.path.rows() - 1));
  for (const std::string& obj : wordsOf(plan.start, "is_object")) {
    const Matrix3d rotation = end.getFrame(obj).getRotationMatrix();
    if (!rotations_.contains(obj) || !hasSameSideUp(plan.scenes.front().getFrame(obj), rotation))
      rotations_[obj] = rotation;
  }
}

std::vector<std::string> StandingSides::fallen(const Config& C,
                                               const std::map<std::string, std::string>& in_hands) const {
  std::vector<std::string> names;
  for (const auto& [obj, rotation] : rotations_) {
    if (in_hands.contains(obj) || standsAs(C.getFrame(obj), rotation)) continue;
    const std::optional<Frame> place = C.getFrame(obj).getParent();
    if (!place || !leansInside(C, obj, place->getName(), rotation)) names.push_back(obj);
  }
  return names;
}

std::string StandingSides::asGoal(const std::vector<std::string>& objects) const {
  if (objects.empty()) return "";
  std::string goal;
  for (const auto& [obj, rotation] : rotations_) {
    const auto [axis, sign] = upAxis(rotation);
    const bool stays = axis == 2 && sign > 0.;  // actions keep this side up
    if (!stays || std::ranges::count(objects, obj) > 0)
      goal += cat(" (up ", std::string(1, "xyz"[axis]), sign < 0. ? "Neg" : "", " ", obj, ")");
  }
  return goal;
}

}  // namespace kinegraph::inline api_internal
