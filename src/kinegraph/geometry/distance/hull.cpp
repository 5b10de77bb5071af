#include <algorithm>
#include <limits>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/geometry/distance/hull.h"
#include "kinegraph/geometry/shapes/convex_hull.h"

namespace kinegraph {

namespace {

constexpr double kFacetRounding = 1e-9;  ///< m
constexpr std::size_t kMany = 48;        ///< from this number of points, climbing along neighbors beats a linear search

/// Depth of a point below all facets, m; 0 outside.
double depthIn(const Mesh& hull, const Vector3d& point) {
  double depth = std::numeric_limits<double>::infinity();
  for (const auto& triangle : hull.triangles) {
    const Vector3d& a = hull.vertices[triangle[0]];
    const Vector3d normal = (hull.vertices[triangle[1]] - a).cross(hull.vertices[triangle[2]] - a).normalized();
    if (normal.isZero(.5)) return 0.;  // a degenerate triangle
    depth = std::min(depth, normal.dot(a - point));
  }
  return std::max(depth - kFacetRounding, 0.);
}

}  // namespace

int Hull::farthest(const Vector3d& direction) const {
  if (points.empty()) throw ValueError("the hull has no points");
  int best = 0;
  double height = direction.dot(points[0]);
  if (first_neighbor.empty()) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double other = direction.dot(points[i]);
      if (other > height) {
        height = other;
        best = int(i);
      }
    }
    return best;
  }
  for (bool climbing = true; climbing;) {
    climbing = false;
    for (std::uint32_t k = first_neighbor[best], end = first_neighbor[best + 1]; k < end; ++k) {
      const double other = direction.dot(points[neighbors[k]]);
      if (other > height) {
        height = other;
        best = int(neighbors[k]);
        climbing = true;
        break;
      }
    }
  }
  return best;
}

Hull geometry_internal::makeHull(const std::vector<Vector3d>& points, const Vector3d& center, double& inner) {
  Hull hull;
  inner = 0.;
  if (!spanVolume(points)) {
    std::set<std::array<double, 3>> known;
    for (const Vector3d& p : points) {
      if (known.insert({p.x(), p.y(), p.z()}).second) hull.points.push_back(p);
    }
    return hull;
  }
  Mesh mesh = convexHull(points);
  inner = depthIn(mesh, center);
  hull.points = std::move(mesh.vertices);
  if (hull.points.size() < kMany) return hull;
  std::vector<std::set<std::uint32_t>> next(hull.points.size());
  for (const auto& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      next[triangle[k]].insert(triangle[(k + 1) % 3]);
      next[triangle[(k + 1) % 3]].insert(triangle[k]);
    }
  }
  if (std::any_of(next.begin(), next.end(), [](const auto& list) { return list.empty(); })) return hull;
  for (const auto& list : next) {
    hull.first_neighbor.push_back(std::uint32_t(hull.neighbors.size()));
    hull.neighbors.insert(hull.neighbors.end(), list.begin(), list.end());
  }
  hull.first_neighbor.push_back(std::uint32_t(hull.neighbors.size()));
  return hull;
}

}  // namespace kinegraph
