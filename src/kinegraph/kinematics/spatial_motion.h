#pragma once

#include "kinegraph/kinematics/dynamics.h"

namespace kinegraph::inline kinematics_internal {

/// Velocity field of a rigid body, or its rate: angular, and linear at the world's origin.
struct Motion {
  Vector3d angular = Vector3d::Zero(), linear = Vector3d::Zero();

  void add(double factor, const Motion& other) {
    angular += factor * other.angular;
    linear += factor * other.linear;
  }
};

/// Returns the rate of a velocity field B that moves with A: their Lie bracket.
inline Motion carried(const Motion& A, const Motion& B) {
  return {A.angular.cross(B.angular), A.angular.cross(B.linear) + A.linear.cross(B.angular)};
}

/// Momentum or force: angular about the world's origin, and linear.
struct Wrench {
  Vector3d angular = Vector3d::Zero(), linear = Vector3d::Zero();

  void add(double factor, const Wrench& other) {
    angular += factor * other.angular;
    linear += factor * other.linear;
  }
};

/// Returns the rate of a wrench that moves with A.
inline Wrench carried(const Motion& A, const Wrench& w) {
  return {A.angular.cross(w.angular) + A.linear.cross(w.linear), A.angular.cross(w.linear)};
}

struct WorldInertia {
  double mass;
  Vector3d com;
  Matrix3d matrix;

  WorldInertia(const LinkInertia& inertia, const RigidTransform& X_WL)
      : mass(inertia.mass), com(X_WL * inertia.com), matrix(X_WL.R * inertia.matrix * X_WL.R.transpose()) {}

  Wrench times(const Motion& motion) const {
    const Vector3d linear = mass * (motion.linear + motion.angular.cross(com));
    return {matrix * motion.angular + com.cross(linear), linear};
  }
};

inline Motion column(const State& state, int index) { return {state.twist(index).angular, state.twist(index).linear}; }

inline double power(const Motion& motion, const Wrench& wrench) {
  return motion.angular.dot(wrench.angular) + motion.linear.dot(wrench.linear);
}

}  // namespace kinegraph::inline kinematics_internal
