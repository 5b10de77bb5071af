#include "kinegraph/task_planning/facing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "kinegraph/scene/tree/frame_data.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr double kVertical = .98;  ///< least vertical component of an axis
constexpr double kAway = 2.;       ///< rad: an arm that is rotated farther faces away
constexpr double kOnAxis = .05;    ///< m: a point that is closer to the axis has no direction

/// The axis of a hinge in the world; zero for other joints.
Vector3d hingeAxis(const Frame& frame) {
  const FrameData& data = frame.data();
  if (!data.moves() || !data.joint->active || data.joint->mimic) return Vector3d::Zero();
  const Joint& joint = *data.joint;
  if (joint.dofs() != 1 || joint.steps.size() != 1 || joint.steps[0].translates()) return Vector3d::Zero();
  return joint.steps[0].sign * (frame.getRotationMatrix() * joint.steps[0].direction(joint.axis));
}

}  // namespace

VectorXd facing(const Config& C, const std::string& hand, const Vector3d& point) {
  VectorXd q = C.getJointState();
  std::optional<Frame> base;  // the vertical hinge that is closest to the root
  for (std::optional<Frame> frame = C.getFrame(hand); frame; frame = frame->getParent())
    if (std::abs(hingeAxis(*frame).z()) > kVertical) base = frame;
  if (!base) return q;
  const std::vector<std::string> joints = C.getJointNames();
  const auto at = std::ranges::find(joints, base->getName());
  if (at == joints.end()) return q;
  const Vector3d from = C.getFrame(hand).getPosition() - base->getPosition(), to = point - base->getPosition();
  const double x = from.x() * to.x() + from.y() * to.y(), y = from.x() * to.y() - from.y() * to.x();
  const double angle = std::atan2(y, x), full = 2. * std::numbers::pi;
  if (std::abs(angle) < kAway || std::min(from.head<2>().norm(), to.head<2>().norm()) < kOnAxis) return q;
  const Joint& joint = *base->data().joint;
  const double share = (hingeAxis(*base).z() > 0. ? 1. : -1.) / joint.scale;
  for (const double turn : {angle, angle > 0. ? angle - full : angle + full}) {
    const double turned = q[at - joints.begin()] + share * turn;
    if (joint.lower.size() == 1 && joint.lower[0] < joint.upper[0] &&
        (turned < joint.lower[0] || turned > joint.upper[0]))
      continue;
    q[at - joints.begin()] = turned;
    return q;
  }
  return q;
}

}  // namespace kinegraph::inline task_planning_internal
