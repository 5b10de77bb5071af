#include "kinegraph/rendering/framing.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/geometry/shapes/tessellation.h"
#include "kinegraph/scene/visual_meshes.h"

namespace kinegraph {

namespace {

/// The vertices of all that is shown, in the world.
std::vector<Vector3d> shownPoints(const Config& config) {
  std::vector<Vector3d> points;
  VisualMeshes visual_meshes;
  SceneTree& scene = *config.scene();
  for (const auto& frame : scene.frames()) {
    if (!frame->shape || servesCollisionsOnly(*frame->shape)) continue;
    if (frame->shape->color && (*frame->shape->color)[3] <= 0.) continue;
    const std::shared_ptr<const Geometry> visual = visual_meshes.of(*frame->shape);
    const Geometry& geometry = visual ? *visual : *frame->shape->geometry;
    const Pose X = scene.worldPose(*frame);
    for (const Vector3f& vertex : tessellate(geometry).vertices) points.push_back(X * vertex.cast<double>());
  }
  return points;
}

}  // namespace

bool servesCollisionsOnly(const Shape& shape) {
  constexpr double kFaint = .25;  // as the page has it
  return shape.contact != 0 && shape.color && (*shape.color)[3] <= kFaint;
}

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

Camera fitted(Camera camera, const Config& config) {
  const std::optional<ShownBall> ball = shownBall(config);
  if (!ball) return camera;
  const double radius = std::max(ball->radius, 1e-3);
  const double smaller_side = std::min(1., double(camera.width) / camera.height);
  const double half_angle = std::atan(.5 * smaller_side / camera.focal_length);
  const double distance = radius / std::sin(half_angle);
  const Vector3d forward = camera.pose.q * Vector3d::UnitZ();
  camera.pose.p = ball->center - distance * forward;
  if (camera.ortho_height > 0.) camera.ortho_height = 2. * radius / smaller_side;
  camera.near = std::min(camera.near, .5 * (distance - radius));
  camera.far = std::max(camera.far, 2. * (distance + radius));
  return camera;
}

}  // namespace kinegraph
