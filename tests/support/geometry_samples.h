#pragma once

#include <vector>

#include "kinegraph/common/random.h"
#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::testing {

constexpr double kGeneral = 1e-6;  ///< accuracy of the general algorithm for convex bodies

inline RigidTransform at(double x, double y, double z, const Matrix3d& R = Matrix3d::Identity()) {
  return {R, Vector3d(x, y, z)};
}

inline Vector3d randomVector(Rng& rng, double spread = 1.) {
  const double x = rng.normal(), y = rng.normal(), z = rng.normal();
  return spread * Vector3d(x, y, z);
}

inline Matrix3d randomRotation(Rng& rng) {
  const Vector3d axis = randomVector(rng);
  return Quaterniond(rng.normal(), axis.x(), axis.y(), axis.z()).normalized().toRotationMatrix();
}

/// Uniform rotation, normally distributed position.
inline RigidTransform randomTransform(Rng& rng, double spread = 1.) {
  const Matrix3d R = randomRotation(rng);
  return {R, randomVector(rng, spread)};
}

/// A rotation by |w| about w.
inline Matrix3d rotationBy(const Vector3d& w) {
  const double angle = w.norm();
  return angle > 0. ? Eigen::AngleAxisd(angle, w / angle).toRotationMatrix() : Matrix3d(Matrix3d::Identity());
}

inline std::vector<Vector3d> boxCorners(const Vector3d& half) {
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back(half.cwiseProduct(Vector3d(i & 1 ? 1. : -1., i & 2 ? 1. : -1., i & 4 ? 1. : -1.)));
  }
  return corners;
}

/// The convex hull of `points` swept by a ball.
inline Geometry sweptHullOf(const std::vector<Vector3d>& points, double radius) {
  Mesh mesh;
  mesh.vertices = points;
  return {ShapeType::ssCvx, {radius}, std::make_shared<Mesh>(mesh)};
}

}  // namespace kinegraph::testing
