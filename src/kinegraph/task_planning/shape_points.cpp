#include "kinegraph/task_planning/shape_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/distance/collision_body.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/geometry/shapes/tessellation.h"

namespace kinegraph::inline task_planning_internal {

namespace {

bool isOf(const Frame& frame, ShapeKind::Body body) {
  return frame.getShapeType() != ShapeType::none && shapeKind(frame.getShapeType()).body == body;
}

}  // namespace

std::vector<Vector3d> shapePoints(const Frame& frame) {
  const auto& shape = frame.data().shape;
  if (!shape) return {};
  const Geometry& geometry = *shape->geometry;
  if (geometry.mesh && geometry.type != ShapeType::ssCvx) return geometry.mesh->vertices;
  return tessellate(geometry).vertices;
}

std::vector<Vector3d> boxCorners(const Frame& frame) {
  const auto& shape = frame.data().shape;
  if (!shape) return {};
  const std::shared_ptr<const CollisionBody> body = shape->body();
  const Vector3d half = body->boundHalf().array() + body->radius();
  std::vector<Vector3d> corners;
  for (int k = 0; k < 8; ++k) {
    const Vector3d signs(k & 1 ? 1. : -1., k & 2 ? 1. : -1., k & 4 ? 1. : -1.);
    corners.emplace_back(body->boundCenter() + half.cwiseProduct(signs));
  }
  return corners;
}

Eigen::AlignedBox3d boxAround(const Frame& frame) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : shapePoints(frame)) box.extend(point);
  return box;
}

bool hasTop(const Frame& frame) { return isOf(frame, ShapeKind::Body::box) || isOf(frame, ShapeKind::Body::cylinder); }

Eigen::Vector2d placeSides(const Frame& place) {
  if (!hasTop(place))
    throw ValueError(
        cat("planTask: nothing can stand on '", place.getName(), "'; expected a box or a cylinder as a place"));
  const std::vector<double> size = place.getSize();
  if (isOf(place, ShapeKind::Body::cylinder)) return Eigen::Vector2d::Constant(std::numbers::sqrt2 * size[1]);
  return {size[0], size[1]};
}

double diagonalOf(const Frame& frame, std::size_t count) {
  std::vector<double> size = frame.getSize();
  if (isOf(frame, ShapeKind::Body::cylinder)) size = {2. * size[1], 0., size[0]};
  double squares = 0.;
  for (std::size_t k = 0; k < std::min(count, size.size()); ++k) squares += size[k] * size[k];
  return std::sqrt(squares);
}

}  // namespace kinegraph::inline task_planning_internal
