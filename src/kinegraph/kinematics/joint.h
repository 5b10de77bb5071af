#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/kinematics/motion_kind.h"
#include "kinegraph/math/pose.h"

namespace kinegraph {

/// Kinds of joints. The numbers are those of the Python enum `ry.JT`.
enum class JointType : int {
  none = 0,
  hingeX = 1,
  hingeY = 2,
  hingeZ = 3,
  transX = 4,
  transY = 5,
  transZ = 6,
  hinge = 7,
  circleZ = 8,
  transXY = 9,
  trans3 = 10,
  transXYPhi = 11,
  transYPhi = 12,
  universal = 13,
  rigid = 14,
  quatBall = 15,
  phiTransXY = 16,
  XBall = 17,
  free = 18,
  generic = 19,
  tau = 20,
};

const std::vector<std::pair<std::string, JointType>>& jointTypeNames();
std::string jointTypeName(JointType type);

/// Are the inverses of this type's motions motions of the same type, with other dofs?
bool hasInverses(JointType type);

/// The type of that name, with or without the prefix "JT_". Throws ValueError with the legal and the nearest words.
JointType jointTypeFromName(std::string_view name);

/// One elementary motion. Every joint type is a short sequence of them, each in the frame that the previous one
/// reached.
struct MotionStep {
  using Kind = MotionKind;
  using Effect = MotionFacts::Effect;
  Kind kind;
  int axis = 0;      ///< 0 x, 1 y, 2 z
  double sign = 1.;  ///< of the dof

  const MotionFacts& facts() const { return kMotionFacts[int(kind)]; }
  int dofs() const { return facts().dofs; }
  bool slides() const { return facts().effect == Effect::slides; }
  bool turns() const { return facts().effect == Effect::turns; }
  bool orients() const { return facts().effect == Effect::orients; }
  bool moves() const { return facts().effect != Effect::none; }

  /// The unit axis that it slides along or turns about, in the frame that the previous step reached; `joint_axis` is
  /// the joint's own. Of no meaning for quaternions and time.
  Vector3d direction(const Vector3d& joint_axis) const {
    return kind == Kind::rotateAbout ? joint_axis : Vector3d(Vector3d::Unit(axis));
  }
};

/// The steps of a joint type. `code` has a letter per dof for JointType::generic: x y z a b c (capital: negated), wxyz
/// for a quaternion, t for time. Throws ValueError for a code that makes no sense.
std::vector<MotionStep> motionSteps(JointType type, std::string_view code = {});

/// Number of dofs of a step sequence.
int motionDofs(const std::vector<MotionStep>& steps);

/// The dof values for which the motion is the identity: zeros, and 1 for the w (c) of a quaternion (circle).
VectorXd motionIdentity(const std::vector<MotionStep>& steps);

/// Relative pose of a joint with dofs `q`; `scale` multiplies every dof, `axis` is used by rotateAbout.
Pose motionPose(const std::vector<MotionStep>& steps, const Vector3d& axis, double scale, const double* q);

/// The dofs that bring the motion nearest to the pose `X`: exact where the joint can reach it.
VectorXd motionProject(const std::vector<MotionStep>& steps, const Vector3d& axis, double scale, const Pose& X);

}  // namespace kinegraph
