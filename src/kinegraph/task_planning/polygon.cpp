#include "kinegraph/task_planning/polygon.h"

#include <algorithm>
#include <limits>

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

double crossOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

Polygon hullOf(Polygon points) {
  const auto isBefore = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::ranges::sort(points, isBefore);
  Polygon hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Eigen::Vector2d& point : points) {
      while (hull.size() >= first + 2 && crossOf(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.)
        hull.pop_back();
      hull.push_back(point);
    }
    if (hull.size() > 1) hull.pop_back();  // the other side begins there
    std::ranges::reverse(points);
  }
  return hull;
}

Polygon clipped(Polygon polygon, const Eigen::Vector2d& half) {
  for (int edge = 0; edge < 4; ++edge) {
    const int axis = edge / 2;
    const double sign = edge % 2 ? -1. : 1.;
    const auto room = [&](const Eigen::Vector2d& p) { return half[axis] - sign * p[axis]; };
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if (room(a) >= 0.) kept.push_back(a);
      if (room(a) * room(b) < 0.) kept.push_back(a + room(a) / (room(a) - room(b)) * (b - a));
    }
    polygon = std::move(kept);
  }
  return polygon;
}

double gapTo(const Eigen::Vector2d& point, const Polygon& polygon) {
  if (polygon.empty()) return kInfinite;
  return std::max(0., -depthIn(point, polygon));
}

double depthIn(const Eigen::Vector2d& point, const Polygon& polygon) {
  double nearest = kInfinite;
  bool is_inside = polygon.size() > 2;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], way = polygon[(i + 1) % polygon.size()] - a;
    is_inside = is_inside && crossOf(way, point - a) >= 0.;
    const double share = std::clamp(way.dot(point - a) / std::max(way.squaredNorm(), 1e-30), 0., 1.);
    nearest = std::min(nearest, (point - a - share * way).norm());
  }
  return is_inside ? nearest : -nearest;
}

}  // namespace kinegraph::inline task_planning_internal
