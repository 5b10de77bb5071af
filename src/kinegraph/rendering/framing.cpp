#include "kinegraph/rendering/camera_renderer.h"

#include <algorithm>
#include <limits>

#include "kinegraph/geometry/shapes/tessellation.h"
#include "kinegraph/rendering/shown_shapes.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

/// Returns the vertices of all visible shapes, in the world.
std::vector<Vector3d> shownPoints(const Config& config) {
  std::vector<Vector3d> points;
  VisualMeshes visual_meshes;
  SceneTree& scene = *config.scene();
  for (const ShownShape& shown : shownShapes(scene, visual_meshes, false)) {
    const Pose X = scene.worldPose(*scene.frames()[std::size_t(shown.frame)]);
    for (const Vector3d& vertex : tessellate(*shown.geometry).vertices) points.push_back(X.p + X.q * vertex);
  }
  return points;
}

}  // namespace

std::optional<ShownBall> shownBall(const Config& config) {
  const std::vector<Vector3d> points = shownPoints(config);
  if (points.empty()) return std::nullopt;
  Vector3d low = points.front(), high = low;
  for (const Vector3d& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  ShownBall ball{.5 * (low + high), 0.};
  for (const Vector3d& point : points) ball.radius = std::max(ball.radius, (point - ball.center).norm());
  return ball;
}

/// Fits the camera to all visible points. Planes through the camera's center c bound the image. A point lies inside a
/// pair of them if
///     |x - c_x| <= t (z - c_z),
/// where t is the tangent of half the angle between the planes. Over all points this bounds c_z t - c_x and c_z t + c_x
/// from above; the narrowest view meets both bounds.
Camera fitted(Camera camera, const Config& config) {
  constexpr double kShare = .92;  // of the image's width and height
  const std::vector<Vector3d> points = shownPoints(config);
  if (points.empty()) return camera;
  const Eigen::Vector2d half(.5 * kShare * camera.width / camera.height, .5 * kShare);  // image heights
  const bool is_pinhole = !(camera.ortho_height > 0.);
  const Eigen::Vector2d t = is_pinhole ? Eigen::Vector2d(half / camera.focal_length) : Eigen::Vector2d::Zero();
  Eigen::Vector2d below = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), above = below;
  double nearest = below.x(), farthest = -below.x();
  for (const Vector3d& point : points) {
    const Vector3d p = camera.pose.q.conjugate() * point;
    below = below.cwiseMin(t * p.z() - p.head<2>());
    above = above.cwiseMin(t * p.z() + p.head<2>());
    nearest = std::min(nearest, p.z());
    farthest = std::max(farthest, p.z());
  }
  Vector3d center;
  center.head<2>() = .5 * (above - below);
  const double depth = std::max(farthest - nearest, 1e-3), gap = .05 * depth;
  if (is_pinhole) {
    center.z() = std::min((.5 * (above + below)).cwiseQuotient(t).minCoeff(), nearest - gap);
  } else {
    center.z() = nearest - depth;
    camera.ortho_height = std::max(-(.5 * (above + below)).cwiseQuotient(half).minCoeff(), 1e-3);
  }
  camera.pose.p = camera.pose.q * center;
  camera.near = std::min(camera.near, .5 * (nearest - center.z()));
  camera.far = std::max(camera.far, 2. * (farthest - center.z()));
  return camera;
}

}  // namespace kinegraph
