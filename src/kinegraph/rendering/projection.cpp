#include "kinegraph/rendering/projection.h"

namespace kinegraph::inline rendering_internal {

namespace {

/// Returns the matrix from the world to the axes of a camera: x to the right, y down, z forward.
Eigen::Matrix4d toAxes(const Pose& pose) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = pose.q.toRotationMatrix().transpose();
  matrix.topRightCorner<3, 1>() = -(matrix.topLeftCorner<3, 3>() * pose.p);
  return matrix;
}

}  // namespace

Eigen::Matrix4d projection(const Camera& camera) {
  const double n = camera.near, f = camera.far, ratio = double(camera.height) / camera.width;
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  if (camera.ortho_height > 0.) {
    matrix.diagonal() << 2. / camera.ortho_height * ratio, -2. / camera.ortho_height, 2. / (f - n), 1.;
    matrix(2, 3) = -(f + n) / (f - n);
  } else {
    matrix.diagonal() << 2. * camera.focal_length * ratio, -2. * camera.focal_length, (f + n) / (f - n), 0.;
    matrix(2, 3) = -2. * f * n / (f - n);
    matrix(3, 2) = 1.;
  }
  return matrix * toAxes(camera.pose);
}

void depthToMeters(std::vector<float>& depth, const Camera& camera) {
  const double n = camera.near, f = camera.far;
  for (float& d : depth) {
    if (d >= 1.f)
      d = -1.f;
    else
      d = float(camera.ortho_height > 0. ? n + d * (f - n) : n * f / (f - d * (f - n)));
  }
}

}  // namespace kinegraph::inline rendering_internal
