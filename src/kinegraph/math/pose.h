#pragma once

#include "kinegraph/math/eigen.h"

namespace kinegraph {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector4d;
using Eigen::VectorXd;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Vector7d = Eigen::Matrix<double, 7, 1>;

/// Returns the skew matrix of a vector: skew(a) b = a x b.
Matrix3d skew(const Vector3d& a);

/// A rigid transform as rotation matrix and position, for the kinematic kernels.
/// `X_WF * p_FQ` is point Q in W.
struct RigidTransform {
  Matrix3d R = Matrix3d::Identity();
  Vector3d p = Vector3d::Zero();

  RigidTransform operator*(const RigidTransform& other) const { return {R * other.R, p + R * other.p}; }
  Vector3d operator*(const Vector3d& point) const { return p + R * point; }
  RigidTransform inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

/// A pose: position (m) and unit quaternion. As array: x y z qw qx qy qz.
struct Pose {
  Vector3d p = Vector3d::Zero();
  Quaterniond q = Quaterniond::Identity();

  Pose() = default;
  Pose(const Vector3d& position, const Quaterniond& rotation) : p(position), q(rotation) {}
  explicit Pose(const RigidTransform& X) : p(X.p), q(X.R) {}

  /// Reads 7 (x y z qw qx qy qz), 3 (position) or 4 (quaternion w x y z) numbers, and normalizes the quaternion.
  /// Throws ValueError for another count, non-finite numbers or a zero quaternion.
  static Pose fromNumbers(const VectorXd& numbers);

  Pose operator*(const Pose& other) const { return {p + q * other.p, q * other.q}; }
  Pose inverse() const { return {-(q.conjugate() * p), q.conjugate()}; }
  RigidTransform transform() const { return {q.toRotationMatrix(), p}; }
  Vector7d numbers() const;
  Pose canonical() const;  ///< the same pose, with a quaternion whose first nonzero entry is positive
  bool isIdentity(double tolerance = 0.) const;  ///< position and rotation (either sign) within `tolerance`
};

/// Returns the unit quaternion of w x y z. Throws ValueError with the name `what` for zero or non-finite input.
Quaterniond unitQuaternion(const Vector4d& wxyz, const char* what = "quaternion");
/// Returns the entries of a quaternion in the order w x y z.
inline Vector4d wxyz(const Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

/// Returns the rotation about a coordinate axis (0 x, 1 y, 2 z) by `angle` rad.
Matrix3d axisRotation(int axis, double angle);

/// Returns the pose of an upright camera at `position` that faces `target`: x right, y down, z forward.
Pose lookAt(const Vector3d& position, const Vector3d& target);

}  // namespace kinegraph
