#include "kinegraph/perception/known_points.h"

#include <algorithm>

#include "kinegraph/geometry/distance/proximity.h"

namespace kinegraph::inline perception_internal {

namespace {

constexpr std::size_t kEvery = 397;         // of the pixels
constexpr double kDeep = .015;              // m, inside of a shape
constexpr double kStep = .03, kBack = .75;  // m, along the view

/// Whether the camera looked through a shape to see the point of a pixel.
bool isBehind(const ObservedView& view, std::size_t pixel, const std::vector<const KnownShape*>& shapes) {
  const double depth = view.depth[pixel];
  const Vector3d& eye = view.X_WC.p;
  const Vector3d along = (view.point(int(pixel) / view.width, int(pixel) % view.width) - eye) / depth;
  const double last = depth - 3. * view.noise * depth * depth;
  for (double at = last; at > std::max(last - kBack, 0.); at -= kStep) {
    const Vector3d point = eye + at * along;
    if (std::any_of(shapes.begin(), shapes.end(), [&](auto* shape) { return isWithin(*shape, point, -kDeep); }))
      return true;
  }
  return false;
}

}  // namespace

bool isWithin(const KnownShape& shape, const Vector3d& point, double distance) {
  const CollisionBody& body = *shape.body;
  if (body.core() == CollisionBody::Core::half_space)
    return proximity(*pointBody(), {Matrix3d::Identity(), point}, body, shape.X_WB).distance <= distance;
  const double reach = std::max(body.radius() + distance, 0.), square = squaredPointToCore(body, shape.X_WB, point);
  if (square > reach * reach) return false;
  if (body.core() <= CollisionBody::Core::cylinder && square > 0.) return true;  // exact
  return proximity(*pointBody(), {Matrix3d::Identity(), point}, body, shape.X_WB).distance <= distance;
}

double shareBehind(const ObservedView& view, const std::vector<KnownShape>& known) {
  std::vector<const KnownShape*> shapes;
  for (const KnownShape& shape : known) {
    const bool is_exact = shape.body->core() <= CollisionBody::Core::cylinder;  // hulls of meshes may be hollow
    if (!shape.moves && is_exact && !isWithin(shape, view.X_WC.p, 0.)) shapes.push_back(&shape);
  }
  int behind = 0, all = 0;
  for (std::size_t i = 0; i < view.depth.size(); i += kEvery) {
    if (view.depth[i] <= 0.f) continue;
    ++all;
    behind += isBehind(view, i, shapes);
  }
  return all > 0 ? double(behind) / all : 0.;
}

}  // namespace kinegraph::inline perception_internal
