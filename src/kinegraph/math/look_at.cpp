#include "kinegraph/math/pose.h"

namespace kinegraph {

Pose lookAt(const Vector3d& position, const Vector3d& target) {
  Vector3d forward = target - position;
  if (forward.norm() < 1e-12) forward = Vector3d::UnitX();
  forward.normalize();
  Vector3d right = forward.cross(Vector3d::UnitZ());
  if (right.norm() < 1e-9) right = Vector3d::UnitX();  // straight up or down
  right.normalize();
  Matrix3d R;
  R << right, forward.cross(right), forward;
  return {position, Quaterniond(R)};
}

}  // namespace kinegraph
