#include "kinegraph/geometry/shapes/convex_hull.h"

#include <coal/shape/convex.h>

#include <algorithm>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph {

namespace {

/// The point that is highest by `height`.
template <class Height>
Vector3d highest(const std::vector<Vector3d>& points, const Height& height) {
  return *std::max_element(points.begin(), points.end(),
                           [&](const Vector3d& p, const Vector3d& q) { return height(p) < height(q); });
}

}  // namespace

bool spanVolume(const std::vector<Vector3d>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite())
      throw ValueError(cat("point ", i, " of a hull is (", points[i].transpose(), "); it must be finite"));
  }
  if (points.size() < 4) return false;
  // The tallest tetrahedron on the longest triangle on the farthest two.
  const Vector3d a = points[0];
  const Vector3d b = highest(points, [&](const Vector3d& p) { return (p - a).squaredNorm(); }) - a;
  const Vector3d c = highest(points, [&](const Vector3d& p) { return (p - a).cross(b).squaredNorm(); }) - a;
  const Vector3d across = b.cross(c),
                 d = highest(points, [&](const Vector3d&p) { return std::abs((p - a).dot(across)); }) - a;
  const double extent = b.norm(), rounding = 1e-9 * extent + 1e-13 * a.norm();
  return across.norm() > rounding * extent && std::abs(d.dot(across)) > rounding * across.norm();
}

Mesh convexHull(const std::vector<Vector3d>& points) {
  if (points.size() < 4) throw ValueError(cat("a convex hull needs at least 4 points, got ", points.size()));
  if (!spanVolume(points)) throw ValueError(cat("the ", points.size(), " points of a convex hull lie in one plane"));
  auto copy = std::make_shared<std::vector<coal::Vec3s>>(points.begin(), points.end());
  std::unique_ptr<coal::ConvexBase> hull;
  try {
    hull.reset(coal::ConvexBase::convexHull(copy, unsigned(points.size()), true));
  } catch (const std::exception& error) {
    throw ValueError(cat("the convex hull of ", points.size(), " points cannot be built: ", error.what()));
  }
  const auto* polytope = dynamic_cast<const coal::Convex<coal::Triangle>*>(hull.get());
  if (!polytope) throw ValueError("the convex hull has no triangles");
  Mesh mesh;
  mesh.vertices.assign(polytope->points->begin(), polytope->points->begin() + polytope->num_points);
  Vector3d center = Vector3d::Zero();
  for (const Vector3d& vertex : mesh.vertices) center += vertex / double(mesh.vertices.size());
  for (unsigned i = 0; i < polytope->num_polygons; ++i) {
    const auto& polygon = (*polytope->polygons)[i];
    std::array<std::uint32_t, 3> triangle = {std::uint32_t(polygon[0]), std::uint32_t(polygon[1]),
                                             std::uint32_t(polygon[2])};
    const Vector3d a = mesh.vertices[triangle[0]], b = mesh.vertices[triangle[1]], c = mesh.vertices[triangle[2]];
    if ((b - a).cross(c - a).dot(a - center) < 0.) std::swap(triangle[1], triangle[2]);
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace kinegraph
