#include "kinegraph/geometry/distance/contact_patch.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/geometry/distance/closed_form/nearest_points.h"

namespace kinegraph::inline geometry_internal {

namespace {

using Core = CollisionBody::Core;

template <class Point, int Most>
struct Points {
  std::array<Point, Most> items;
  int size = 0;

  void add(const Point& point) {
    if (size < Most) items[std::size_t(size++)] = point;
  }
  const Point& operator[](int i) const { return items[std::size_t(i)]; }
};

constexpr int kMaxCorners = 64;  ///< corners of a patch
using Patch = Points<Vector3d, kMaxCorners>;
using Polygon = Points<Eigen::Vector2d, 2 * kMaxCorners>;

/// Adds the corners of a hull at the same height along d as the farthest one.
void addCorners(const Hull& hull, const Vector3d& d, Patch& patch) {
  const int best = hull.farthest(d);
  const Vector3d& top = hull.points[std::size_t(best)];
  const auto isTop = [&](const Vector3d& p) { return d.dot(top - p) <= kParallel * (top - p).norm(); };
  if (hull.first_neighbor.empty()) {
    for (const Vector3d& p : hull.points) {
      if (isTop(p)) patch.add(p);
    }
    return;
  }
  std::array<int, kMaxCorners> found{best};  // the corners of a face are neighbors
  int count = 1;
  for (int i = 0; i < count; ++i) {
    const std::size_t corner = std::size_t(found[std::size_t(i)]);
    patch.add(hull.points[corner]);
    for (std::uint32_t k = hull.first_neighbor[corner]; k < hull.first_neighbor[corner + 1] && count < kMaxCorners;
         ++k) {
      const int next = int(hull.neighbors[k]);
      if (!isTop(hull.points[std::size_t(next)]) ||
          std::find(found.begin(), found.begin() + count, next) != found.begin() + count)
        continue;
      found[std::size_t(count++)] = next;
    }
  }
}

/// Adds the farthest corners along d of a box moved by `offset`.
void addBoxCorners(const Vector3d& half, const Vector3d& offset, const Vector3d& d, Patch& patch) {
  for (int i = 0; i < 8; ++i) {
    const Vector3d signs(i & 1 ? 1. : -1., i & 2 ? 1. : -1., i & 4 ? 1. : -1.);
    if ((signs.cwiseProduct(d).array() >= -kParallel).all()) patch.add(signs.cwiseProduct(half) + offset);
  }
}

/// The farthest feature of a core along the unit vector d, in its own frame: the corners of a face, the ends of an
/// edge, or a point.
Patch farthestPatch(const CollisionBody& body, const Vector3d& d) {
  Patch patch;
  const double across = std::hypot(d.x(), d.y()), z = std::copysign(body.halfLength(), d.z());
  switch (body.core()) {
    case Core::hull:
      addCorners(body.hull(), d, patch);
      break;
    case Core::box:
      addBoxCorners(body.halfSides(), Vector3d::Zero(), d, patch);
      break;
    case Core::box_ellipsoid:
      addBoxCorners(body.halfSides(),
                    body.radii().cwiseAbs2().cwiseProduct(d) / std::max(body.radii().cwiseProduct(d).norm(), 1e-100), d,
                    patch);
      break;
    case Core::segment:
    case Core::cylinder: {
      const Vector3d out =
          across > 0. ? Vector3d(body.coreRadius() / across * Vector3d(d.x(), d.y(), 0.)) : Vector3d::Zero();
      if (body.core() == Core::cylinder && across <= kParallel) {
        constexpr int kCorners = 32;
        for (int i = 0; i < kCorners; ++i) {
          const double angle = 2. * M_PI / kCorners * i;
          patch.add({body.coreRadius() * std::cos(angle), body.coreRadius() * std::sin(angle), z});
        }
      } else if (std::abs(d.z()) <= kParallel) {
        patch.add(out + Vector3d(0., 0., z));
        patch.add(out - Vector3d(0., 0., z));
      } else {
        patch.add(out + Vector3d(0., 0., z));
      }
      break;
    }
    default:
      patch.add(Vector3d::Zero());
  }
  return patch;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The convex hull, counterclockwise; two points if it has no area. Source: Andrew, Another efficient algorithm for
/// convex hulls in two dimensions, 1979.
Polygon hullOf(Polygon points, double same) {
  const auto begin = points.items.begin();
  std::sort(begin, begin + points.size, [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y());
  });
  Polygon hull;
  const auto extend = [&](const Eigen::Vector2d& p, int from) {
    while (hull.size >= from + 2) {
      const Eigen::Vector2d edge = hull[hull.size - 1] - hull[hull.size - 2], next = p - hull[hull.size - 1];
      if (cross(edge, next) > same * edge.norm()) break;
      --hull.size;
    }
    hull.add(p);
  };
  for (int i = 0; i < points.size; ++i) extend(points[i], 0);
  const int lower = hull.size - 1;
  for (int i = points.size - 2; i >= 0; --i) extend(points[i], lower);
  if (hull.size > 1) --hull.size;  // equals the first point
  return hull;
}

/// Clips a polygon (or a line, given by its ends) to the left side of the line through `at` along the unit vector
/// `along`. Source: Sutherland & Hodgman, Reentrant polygon clipping, 1974.
Polygon clipped(const Polygon& polygon, const Eigen::Vector2d& at, const Eigen::Vector2d& along, double same) {
  Polygon kept;
  for (int i = 0; i < polygon.size; ++i) {
    const Eigen::Vector2d &from = polygon[i], &to = polygon[(i + 1) % polygon.size];
    const double left_from = cross(along, from - at), left_to = cross(along, to - at);
    if (left_from >= -same) kept.add(from);
    if ((left_from < -same && left_to > same) || (left_from > same && left_to < -same)) {
      kept.add(from + left_from / (left_from - left_to) * (to - from));
    }
  }
  return kept;
}

/// The centroid of the area; without area, the middle of the extent.
Eigen::Vector2d center(const Polygon& polygon) {
  Eigen::Vector2d low = polygon[0], high = low, sum = Eigen::Vector2d::Zero();
  double area = 0.;
  for (int i = 1; i < polygon.size; ++i) {
    low = low.cwiseMin(polygon[i]);
    high = high.cwiseMax(polygon[i]);
  }
  for (int i = 1; i + 1 < polygon.size; ++i) {
    const double part = cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    area += part;
    sum += part / 3. * (polygon[0] + polygon[i] + polygon[i + 1]);
  }
  if (area > 1e-9 * (high - low).squaredNorm()) return sum / area;
  return .5 * (low + high);
}

/// The part of line a beside the parallel line b; empty for crossing lines.
Polygon besides(const Polygon& a, const Polygon& b, double same) {
  const Eigen::Vector2d along = (a[1] - a[0]).normalized(), other = (b[1] - b[0]).normalized();
  if (std::abs(cross(along, other)) > kParallel) return {};
  double low = along.dot(b[0] - a[0]), high = along.dot(b[1] - a[0]);
  if (low > high) std::swap(low, high);
  low = std::max(low, 0.);
  high = std::min(high, (a[1] - a[0]).norm());
  if (low > high + same) return {};
  Polygon part;
  part.add(a[0] + low * along);
  part.add(a[0] + high * along);
  return part;
}

}  // namespace

std::optional<Vector3d> middleOfContact(const CorePair& pair, const Vector3d& m) {
  const Patch on_a = farthestPatch(pair.a, m);
  if (on_a.size < 2) return {};
  const Patch on_b = farthestPatch(pair.b, -(pair.X_AB.R.transpose() * m));
  if (on_b.size < 2) return {};
  const double same = 1e-9 * pair.scale();
  const Vector3d x = m.unitOrthogonal(), y = m.cross(x);
  Polygon flat_a, flat_b;
  double height = m.dot(on_a[0]);
  for (int i = 0; i < on_a.size; ++i) {
    flat_a.add({x.dot(on_a[i]), y.dot(on_a[i])});
    height = std::max(height, m.dot(on_a[i]));
  }
  for (int i = 0; i < on_b.size; ++i) {
    const Vector3d p = pair.X_AB * on_b[i];
    flat_b.add({x.dot(p), y.dot(p)});
  }
  Polygon common = hullOf(flat_a, same), other = hullOf(flat_b, same);
  if (common.size > other.size) std::swap(common, other);  // the polygon with more corners clips
  if (common.size < 2) return {};
  if (other.size == 2) {
    common = besides(common, other, same);
  } else {
    for (int i = 0; i < other.size && common.size > 0; ++i) {
      const Eigen::Vector2d &from = other[i], &to = other[(i + 1) % other.size];
      common = clipped(common, from, (to - from).normalized(), same);
    }
  }
  if (common.size == 0) return {};
  const Eigen::Vector2d middle = center(common);
  return middle.x() * x + middle.y() * y + height * m;
}

}  // namespace kinegraph::inline geometry_internal
