#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/scene/loading/attributes.h"
#include "kinegraph/scene/tree/joint_limits.h"

namespace kinegraph::inline scene_internal {

std::optional<Pose> AttributeReader::readBehind() {
  const auto before = find({"BinvA"}) ? readBefore() : std::nullopt;
  return before ? before->inverse() : readPose({"post", "B"});
}

std::optional<Joint> AttributeReader::readJoint() {
  const Node* node = find({"joint"});
  if (!node) return std::nullopt;
  std::optional<Joint> joint;
  guarded(*node, [&] {
    if (const double* code = node->value.as<double>()) {
      if (!(*code >= 0. && *code <= 1000.)) throw ValueError(cat("joint type ", *code, " does not exist"));
      if (*code != 0.) joint = Joint(JointType(int(*code)));
      return;
    }
    const auto word = text(*node);
    if (!word || *word == "none" || *word == "JT_none") return;
    joint = word->starts_with("_") ? Joint(JointType::generic, word->substr(1)) : Joint(jointTypeFromName(*word));
    if (joint->type == JointType::generic && joint->dofs() == 0) {
      throw ValueError(
          "a generic joint needs its code, one letter per dof: '_xyc' moves along x, then y, then rotates about z");
    }
  });
  if (!joint) return std::nullopt;
  joint->scale = numberOr("joint_scale", 1.);
  if (!std::isfinite(joint->scale) || joint->scale == 0.) {
    error(*find({"joint_scale"}), "expected a finite number other than 0");
    joint->scale = 1.;
  }
  if (const Node* axis = find({"axis"})) {
    const Vector3d direction = vector3(*axis).value_or(Vector3d::Zero());
    if (joint->type != JointType::hinge) {
      error(*axis, cat("only a joint of type hinge has an axis, not ", jointTypeName(joint->type)));
    } else if (!(direction.norm() > 1e-10) || !direction.allFinite()) {
      error(*axis, "expected 3 numbers that are not all zero");
    } else {
      joint->axis = direction.normalized();
    }
  }
  if (joint->dofs() > 0) {
    readLimits(*joint);
    readDofs(*joint);
  }
  joint->control_weight = numberOr("ctrl_H", 1.);
  joint->active = numberOr("joint_active", 1.) != 0.;
  joint->stable = numberOr("joint_stable", 0.) != 0.;
  joint->sample_uniform = numberOr("sampleUniform", 0.);
  joint->sample_deviation = numberOr("sampleSdv", .01);
  return joint;
}

void AttributeReader::readLimits(Joint& joint) {
  const Node* limits = find({"limits"});
  if (!limits) return;
  const auto v = numbers(*limits);
  if (!v || v->empty()) return;
  const std::size_t dofs = std::size_t(joint.dofs());
  if (v->size() < 2 * dofs) {
    return error(*limits, cat("a ", jointTypeName(joint.type), " joint has ", 2 * dofs,
                              " limits (all lower, then all upper), got ", v->size()));
  }
  std::vector<double> given(v->data(), v->data() + 2 * dofs);
  std::string in_turn;
  if (const auto ordered = limitsInTurn(given, in_turn)) {
    warning(*limits, in_turn);
    given = *ordered;
  }
  joint.lower = Eigen::Map<const VectorXd>(given.data(), Eigen::Index(dofs));
  joint.upper = Eigen::Map<const VectorXd>(given.data() + dofs, Eigen::Index(dofs));
  if (const std::string why = limitsError(given); !why.empty()) return error(*limits, why);
  moveToEqualLimits(joint.steps, given, {joint.home.data(), dofs});
  joint.q = joint.home;
}

void AttributeReader::readDofs(Joint& joint) {
  if (const auto q = readDofValues("q", joint)) joint.q = joint.home = *q;
  if (const auto home = readDofValues("home", joint)) joint.home = *home;
}

/// Reads the values of all dofs and normalizes the quaternions among them.
std::optional<VectorXd> AttributeReader::readDofValues(const char* key, const Joint& joint) {
  const Node* node = find({key});
  const auto v = node ? numbers(*node) : std::nullopt;
  if (!v) return std::nullopt;
  VectorXd q(joint.dofs());
  if (v->size() == 1) {
    q.setConstant(v->front());
  } else if (int(v->size()) == joint.dofs()) {
    q = Eigen::Map<const VectorXd>(v->data(), Eigen::Index(v->size()));
  } else {
    error(*node,
          cat("a ", jointTypeName(joint.type), " joint has ", joint.dofs(), " dofs, got ", v->size(), " numbers"));
    return std::nullopt;
  }
  if (!q.allFinite()) error(*node, "expected finite numbers");
  int first = 0;
  for (const MotionStep& step : joint.steps) {
    if (step.orients()) {
      auto part = q.segment(first, step.dofs());
      const double norm = part.norm();
      if (!(norm > 1e-10)) {
        error(*node, step.dofs() == 4 ? "the quaternion in it is zero" : "the (c, s) in it is zero");
        return std::nullopt;
      }
      if (std::abs(norm - 1.) > 1e-15) part /= norm;
    }
    first += step.dofs();
  }
  return q;
}

void AttributeReader::applyJoint(FrameData& frame) {
  const std::optional<Joint> joint = readJoint();
  if (joint && !frame.parent) {
    error(*find({"joint"}), "a frame without a parent cannot have a joint; write 'name (parent): { ... }'");
  } else if (joint) {
    frame.joint = joint;
  } else if (find({"joint"})) {
    frame.joint.reset();
  }
  applyPose(frame);
}

}  // namespace kinegraph::inline scene_internal
