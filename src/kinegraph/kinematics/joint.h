#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/kinematics/motion_kind.h"
#include "kinegraph/math/pose.h"

namespace kinegraph {

/// Inertial parameters of a link. Link 0 is the world; its inertia has no effect.
struct LinkInertia {
  double mass = 0.;                    ///< kg
  Vector3d com = Vector3d::Zero();     ///< center of mass in the link, m
  Matrix3d matrix = Matrix3d::Zero();  ///< about the center of mass, in the link's axes, kg m^2

  /// Adds a rigidly attached part; `X_LF` is its pose in the link.
  void add(const LinkInertia& part, const RigidTransform& X_LF);
};

inline const Vector3d kGravity{0., 0., -9.81};  ///< m/s^2

/// The equation of motion u = M(q) ddq + F(q, dq), with generalized forces u (N m, N).
struct EquationOfMotion {
  MatrixXd M;  ///< n x n
  VectorXd F;  ///< n: Coriolis, centrifugal and gravity terms
};

/// Dynamics in velocities v instead of dq. They equal dq except for quaternions: these 4 dofs, of which 3 are free,
/// have an angular velocity (3 numbers, rad/s) in the axes of the moved link. A free joint has 6 velocities: the linear
/// one in the axes of its parent, m/s, and the angular one in its own axes. Mass matrices are regular then.
///
///     dq = T(q) v                                   velocityMap, n x nv
///     M(q) dv + C(q, v) v + g(q) = u                rigidBodyDynamics
///     h = A(q) v                                    centroidalMomentum
struct RigidBodyDynamics {
  MatrixXd M;  ///< nv x nv, kg, kg m, kg m^2
  MatrixXd C;  ///< nv x nv; dM/dt - 2 C is skew
  VectorXd g;  ///< nv: generalized forces that balance gravity, N m, N
};

/// Types of joints. The numbers are those of the Python enum `ry.JT`.
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

/// Returns true if the inverse of each motion of this type is a motion of the same type.
bool hasInverses(JointType type);

/// Parses a type name, with or without the prefix "JT_". Throws ValueError with the legal and the nearest names.
JointType jointTypeFromName(std::string_view name);

/// An elementary motion. Each joint type is a short sequence of them, each relative to the frame that the previous one
/// reached.
struct MotionStep {
  using Kind = MotionKind;
  using Effect = MotionFacts::Effect;
  Kind kind;
  int axis = 0;      ///< 0 x, 1 y, 2 z
  double sign = 1.;  ///< of the dof

  const MotionFacts& facts() const { return kMotionFacts[int(kind)]; }
  int dofs() const { return facts().dofs; }
  bool translates() const { return facts().effect == Effect::translates; }
  bool rotates() const { return facts().effect == Effect::rotates; }
  bool orients() const { return facts().effect == Effect::orients; }
  bool moves() const { return facts().effect != Effect::none; }

  /// Returns the unit axis of the translation or rotation, in the frame that the previous step reached; `joint_axis` is
  /// the joint's own axis. Undefined for quaternions and time.
  Vector3d direction(const Vector3d& joint_axis) const {
    return kind == Kind::rotateAbout ? joint_axis : Vector3d(Vector3d::Unit(axis));
  }
};

/// Returns the steps of a joint type. For JointType::generic, `code` has one letter per dof: x y z a b c (capital:
/// negated), wxyz for a quaternion, t for time. Throws ValueError for an invalid code.
std::vector<MotionStep> motionSteps(JointType type, std::string_view code = {});

/// Returns the number of dofs of a sequence of steps.
int motionDofs(const std::vector<MotionStep>& steps);

/// Returns the dofs of the identity motion: zeros, and 1 for the w (c) of a quaternion (circle).
VectorXd motionIdentity(const std::vector<MotionStep>& steps);

/// Returns the relative pose of a joint with dofs `q`; `scale` multiplies each dof, rotateAbout uses `axis`.
Pose motionPose(const std::vector<MotionStep>& steps, const Vector3d& axis, double scale, const double* q);

/// Returns the dofs whose motion is closest to the pose `X`; exact if the joint can reach it.
VectorXd motionProject(const std::vector<MotionStep>& steps, const Vector3d& axis, double scale, const Pose& X);

}  // namespace kinegraph
