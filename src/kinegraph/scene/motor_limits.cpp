#include "kinegraph/scene/dynamics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

enum class Motor { velocity, effort };

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Limit of the frame's joint in terms of its motion scale * q; infinite if not given.
double given(const FrameData& frame, Motor motor) {
  const Node* node = frame.attributes->find("ctrl_limits");
  const NumberArray* limits = node ? node->value.as<NumberArray>() : nullptr;
  const std::size_t place = motor == Motor::velocity ? 0 : 1;
  const bool said = limits && limits->numbers.size() > place && limits->numbers[place] > 0.;
  return said ? limits->numbers[place] : kInfinity;
}

/// Marks the dofs of a joint that are angles or lengths, not parts of a quaternion or of a point on a circle.
std::vector<bool> measurable(const Joint& joint) {
  std::vector<bool> result;
  for (const MotionStep& step : joint.steps) {
    const bool one = step.kind == MotionStep::Kind::translate || step.kind == MotionStep::Kind::rotate ||
                     step.kind == MotionStep::Kind::rotateAbout;
    result.insert(result.end(), std::size_t(step.dofs()), one);
  }
  return result;
}

VectorXd motorLimits(SceneTree& scene, Motor motor) {
  const auto model = scene.model();
  VectorXd limits = VectorXd::Constant(model->dofs, kInfinity);
  for (const auto& frame : scene.frames()) {
    if (!frame->moves() || (frame->joint->mimic && motor == Motor::effort)) continue;
    const KinematicModel::DofRange range = model->frame_dofs[dofSource(*frame).id];
    const double limit = given(*frame, motor), scale = std::abs(motionScale(*frame));
    const std::vector<bool> dofs = measurable(*frame->joint);
    if (limit == kInfinity || scale == 0. || range.count != int(dofs.size())) continue;
    const double of_q = motor == Motor::velocity ? limit / scale : limit * scale;
    for (int i = 0; i < range.count; ++i) {
      if (dofs[std::size_t(i)]) limits[range.first + i] = std::min(limits[range.first + i], of_q);
    }
  }
  return limits;
}

}  // namespace

VectorXd getVelocityLimits(const Config& config) { return motorLimits(*config.scene(), Motor::velocity); }

VectorXd getEffortLimits(const Config& config) { return motorLimits(*config.scene(), Motor::effort); }

}  // namespace kinegraph
