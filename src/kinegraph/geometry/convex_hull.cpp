#include "kinegraph/geometry/convex_hull.h"

#include <coal/shape/convex.h>

#include <unordered_map>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph {

Mesh convexHull(const std::vector<Vector3d>& points) {
  if (points.size() < 4) throw ValueError(cat("a convex hull needs at least 4 points, got ", points.size()));
  auto copy = std::make_shared<std::vector<coal::Vec3s>>(points.begin(), points.end());
  std::unique_ptr<coal::ConvexBase> hull;
  try {
    hull.reset(coal::ConvexBase::convexHull(copy, unsigned(points.size()), true));
  } catch (const std::exception& error) {
    throw ValueError(cat("the convex hull of ", points.size(), " points cannot be built; do they lie in one plane?"));
  }
  const auto* polytope = dynamic_cast<const coal::Convex<coal::Triangle>*>(hull.get());
  if (!polytope) throw ValueError("the convex hull has no triangles");
  Mesh mesh;
  mesh.vertices.assign(polytope->points->begin(), polytope->points->begin() + polytope->num_points);
  Vector3d center = Vector3d::Zero();
  for (const Vector3d& vertex : mesh.vertices) center += vertex / double(mesh.vertices.size());
  for (unsigned i = 0; i < polytope->num_polygons; ++i) {
    const auto& polygon = (*polytope->polygons)[i];
    std::array<std::uint32_t, 3> triangle = {std::uint32_t(polygon[0]), std::uint32_t(polygon[1]), std::uint32_t(polygon[2])};
    const Vector3d a = mesh.vertices[triangle[0]], b = mesh.vertices[triangle[1]], c = mesh.vertices[triangle[2]];
    if ((b - a).cross(c - a).dot(a - center) < 0.) std::swap(triangle[1], triangle[2]);
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace kinegraph
