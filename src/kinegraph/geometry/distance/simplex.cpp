#include "kinegraph/geometry/distance/core_pair.h"

namespace kinegraph::inline geometry_internal {

namespace {

/// A convex combination of at most four points.
struct Combination {
  std::array<double, 4> weights{};
  Vector3d point;
};

Combination nearestOf(const Vector3d& a, int i) {
  Combination combination{{}, a};
  combination.weights[std::size_t(i)] = 1.;
  return combination;
}

/// The combination on the line from point i to point j at t in (0, 1).
Combination onEdge(const Vector3d& a, const Vector3d& b, int i, int j, double t) {
  Combination combination{{}, a + t * (b - a)};
  combination.weights[std::size_t(i)] = 1. - t;
  combination.weights[std::size_t(j)] = t;
  return combination;
}

Combination nearestOf(const Vector3d& a, const Vector3d& b, int i, int j) {
  const Vector3d d = b - a;
  const double t = -a.dot(d), square = d.squaredNorm();
  if (t <= 0.) return nearestOf(a, i);
  if (t >= square) return nearestOf(b, j);
  return onEdge(a, b, i, j, t / square);
}

Combination nearestOf(const Vector3d& a, const Vector3d& b, const Vector3d& c, int i, int j, int k) {
  const Vector3d ab = b - a, ac = c - a, n = ab.cross(ac);
  const double area = n.squaredNorm(), longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  if (area > 1e-26 * longest * longest) {
    // Areas opposite to the three corners, seen from the origin's projection.
    const double u = n.dot(b.cross(c)), v = n.dot(c.cross(a)), w = n.dot(a.cross(b));
    if (u > 0. && v > 0. && w > 0.) {
      const double sum = u + v + w;
      Combination combination{{}, n * (n.dot(a) / area)};
      combination.weights[std::size_t(i)] = u / sum;
      combination.weights[std::size_t(j)] = v / sum;
      combination.weights[std::size_t(k)] = w / sum;
      return combination;
    }
  }
  Combination best = nearestOf(a, b, i, j);
  for (const Combination& other : {nearestOf(b, c, j, k), nearestOf(c, a, k, i)}) {
    if (other.point.squaredNorm() < best.point.squaredNorm()) best = other;
  }
  return best;
}

/// The nearest combination of four points; sets `inside` if they enclose the origin.
Combination nearestOfFour(const std::array<MinkowskiPoint, 4>& points, bool& inside) {
  static constexpr int kFaces[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
  const auto w = [&](int i) -> const Vector3d& { return points[std::size_t(i)].w; };
  Combination best{{}, Vector3d::Constant(1e150)};
  inside = true;
  for (const auto& [i, j, k, apex] : kFaces) {
    const Vector3d n = (w(j) - w(i)).cross(w(k) - w(i));
    const double to_apex = n.dot(w(apex) - w(i)), to_origin = -n.dot(w(i));
    const double flat = 1e-13 * n.norm() * (w(apex) - w(i)).norm();
    if (std::abs(to_apex) > flat && to_apex * to_origin > 0.) continue;  // the origin is on the inner side
    inside = false;
    const Combination combination = nearestOf(w(i), w(j), w(k), i, j, k);
    if (combination.point.squaredNorm() < best.point.squaredNorm()) best = combination;
  }
  if (inside) best = {{.25, .25, .25, .25}, Vector3d::Zero()};
  return best;
}

}  // namespace

Vector3d Simplex::reduce(bool& inside) {
  inside = false;
  Combination nearest;
  switch (size) {
    case 1:
      nearest = nearestOf(points[0].w, 0);
      break;
    case 2:
      nearest = nearestOf(points[0].w, points[1].w, 0, 1);
      break;
    case 3:
      nearest = nearestOf(points[0].w, points[1].w, points[2].w, 0, 1, 2);
      break;
    default:
      nearest = nearestOfFour(points, inside);
  }
  int kept = 0;
  for (int i = 0; i < size; ++i) {
    if (nearest.weights[std::size_t(i)] == 0.) continue;
    points[std::size_t(kept)] = points[std::size_t(i)];
    weights[std::size_t(kept++)] = nearest.weights[std::size_t(i)];
  }
  size = kept;
  return nearest.point;
}

}  // namespace kinegraph::inline geometry_internal
