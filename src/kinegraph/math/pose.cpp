#include "kinegraph/math/pose.h"

#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

Matrix3d skew(const Vector3d& a) {
  Matrix3d S;
  S << 0., -a.z(), a.y(), a.z(), 0., -a.x(), -a.y(), a.x(), 0.;
  return S;
}

Quaterniond unitQuaternion(const Vector4d& wxyz, const char* what) {
  const double norm = wxyz.norm();
  if (!wxyz.allFinite()) throw ValueError(cat(what, " has entries that are not finite: ", wxyz.transpose()));
  if (norm < 1e-10) throw ValueError(cat(what, " is zero; expected w x y z of a rotation, e.g. 1 0 0 0"));
  if (std::abs(norm - 1.) < 1e-15) return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
  return {wxyz[0] / norm, wxyz[1] / norm, wxyz[2] / norm, wxyz[3] / norm};
}

Pose Pose::fromNumbers(const VectorXd& numbers) {
  if (!numbers.allFinite()) throw ValueError(cat("pose has entries that are not finite: ", numbers.transpose()));
  switch (numbers.size()) {
    case 3:
      return {numbers, Quaterniond::Identity()};
    case 4:
      return {Vector3d::Zero(), unitQuaternion(numbers)};
    case 7:
      return {numbers.head<3>(), unitQuaternion(numbers.tail<4>())};
    default:
      throw ValueError(cat("a pose has 7 numbers (x y z qw qx qy qz), 3 (position) or 4 (quaternion w x y z), not ",
                           numbers.size()));
  }
}

Vector7d Pose::numbers() const {
  Vector7d out;
  out << p, q.w(), q.x(), q.y(), q.z();
  return out;
}

Pose Pose::canonical() const {
  for (double entry : wxyz(q)) {
    if (entry < 0.) return {p, Quaterniond(-q.coeffs())};
    if (entry > 0.) break;
  }
  return *this;
}

bool Pose::isIdentity(double tolerance) const {
  return p.cwiseAbs().maxCoeff() <= tolerance && q.vec().cwiseAbs().maxCoeff() <= tolerance &&
         std::abs(std::abs(q.w()) - 1.) <= tolerance;
}

Matrix3d axisRotation(int axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Matrix3d R = Matrix3d::Identity();
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  R(i, i) = c;
  R(i, j) = -s;
  R(j, i) = s;
  R(j, j) = c;
  return R;
}

}  // namespace kinegraph
