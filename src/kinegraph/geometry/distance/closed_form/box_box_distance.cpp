#include "kinegraph/geometry/distance/closed_form/box_box_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "kinegraph/geometry/distance/closed_form/box_distance.h"

namespace kinegraph::inline geometry_internal {

namespace {

constexpr double kExact = 1e-11;  ///< sine of the angle below which directions are equal up to rounding

/// A unit normal from b to a, in the frame of a, and the gap between the boxes along it.
struct SeparatingAxis {
  Vector3d normal;
  double gap = -std::numeric_limits<double>::infinity();
};

/// Box b in the frame of box a. All computations below are in the frame of a.
struct BoxPair {
  Vector3d a, b;  ///< half sides
  Matrix3d R;     ///< of b
  Vector3d p;     ///< center of b
  double scale() const { return a.sum() + b.sum(); }
};

/// Returns whether an edge of one box is nearly, but not exactly, parallel to a face of the other: axes across edges
/// are then ill-conditioned.
bool nearlyParallel(const BoxPair& pair) {
  return (pair.R.array().abs() > kExact && pair.R.array().abs() <= kParallel).any();
}

double gapAlong(const BoxPair& pair, const Vector3d& normal) {
  return std::abs(normal.dot(pair.p)) - normal.cwiseAbs().dot(pair.a) -
         (pair.R.transpose() * normal).cwiseAbs().dot(pair.b);
}

/// The axis with the widest gap. An axis across two edges must exceed the face normals by more than rounding.
SeparatingAxis widestGap(const BoxPair& pair) {
  const Matrix3d &R = pair.R, absolute = R.cwiseAbs();
  const Vector3d t = -pair.p, t_b = R.transpose() * t;
  const Vector3d gap_a = t.cwiseAbs() - pair.a - absolute * pair.b;
  const Vector3d gap_b = t_b.cwiseAbs() - pair.b - absolute.transpose() * pair.a;
  int i, j;
  const double best_a = gap_a.maxCoeff(&i), best_b = gap_b.maxCoeff(&j), margin = 1e-14 * pair.scale();
  SeparatingAxis best{signOf(t[i]) * Vector3d::Unit(i), best_a};
  if (best_b > best_a + margin) best = {signOf(t_b[j]) * R.col(j), best_b};
  int edge_a = -1, edge_b = -1;
  double best_gap = best.gap + margin;
  for (i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double norm = std::sqrt(R(i1, j) * R(i1, j) + R(i2, j) * R(i2, j));
      if (norm < 1e-8) continue;
      const double reach = pair.a[i1] * absolute(i2, j) + pair.a[i2] * absolute(i1, j) + pair.b[j1] * absolute(i, j2) +
                           pair.b[j2] * absolute(i, j1);
      const double gap = (std::abs(t[i2] * R(i1, j) - t[i1] * R(i2, j)) - reach) / norm;
      if (gap <= best_gap) continue;
      best_gap = gap;
      edge_a = i;
      edge_b = j;
    }
  }
  if (edge_a >= 0) {
    const Vector3d across = Vector3d::Unit(edge_a).cross(R.col(edge_b)).normalized();
    const double gap = gapAlong(pair, across);
    if (gap > best.gap + margin) best = {signOf(across.dot(t)) * across, gap};
  }
  return best;
}

/// The farthest feature of a box along a direction: a corner, an edge (`free` lists its axis) or a face (two axes).
struct BoxFeature {
  Vector3d center;  ///< in the box's own frame
  std::array<int, 2> free = {-1, -1};
  int dimension = 0;
};

BoxFeature farthest(const Vector3d& half, const Vector3d& direction) {
  BoxFeature feature;
  int own;
  direction.cwiseAbs().maxCoeff(&own);
  for (int i = 0; i < 3; ++i) {
    const bool free = i != own && std::abs(direction[i]) <= kParallel;
    feature.center[i] = free ? 0. : signOf(direction[i]) * half[i];
    if (free) feature.free[feature.dimension++] = i;
  }
  return feature;
}

/// A convex polygon of at most eight corners.
struct ClippedFace {
  std::array<Vector3d, 8> corners;
  int size = 0;

  /// Keeps the part with side * x[axis] <= half. Source: Sutherland & Hodgman, Reentrant polygon clipping, 1974.
  void clip(int axis, double side, double half) {
    const ClippedFace old = *this;
    size = 0;
    for (int i = 0; i < old.size; ++i) {
      const Vector3d &from = old.corners[i], &to = old.corners[(i + 1) % old.size];
      const double over_from = side * from[axis] - half, over_to = side * to[axis] - half;
      if (over_from <= 0.) add(from);
      if ((over_from < 0. && over_to > 0.) || (over_from > 0. && over_to < 0.)) {
        Vector3d crossing = from + over_from / (over_from - over_to) * (to - from);
        crossing[axis] = side * half;
        add(crossing);
      }
    }
  }

  /// The centroid of the area; for a polygon without area, the middle of its extent.
  Vector3d center() const {
    Vector3d sum = Vector3d::Zero(), low = corners[0], high = corners[0];
    for (int i = 1; i < size; ++i) {
      low = low.cwiseMin(corners[i]);
      high = high.cwiseMax(corners[i]);
    }
    double area = 0.;
    for (int i = 1; i + 1 < size; ++i) {
      const double part = (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]).norm();
      area += part;
      sum += part / 3. * (corners[0] + corners[i] + corners[i + 1]);
    }
    if (area > 1e-9 * (high - low).squaredNorm()) return sum / area;
    return .5 * (low + high);
  }

 private:
  void add(const Vector3d& corner) {
    if (size < int(corners.size())) corners[size++] = corner;
  }
};

/// The middle of the part of `feature` above the face of another box; nullopt if no part is. `feature` belongs to a box
/// with half sides `half` at R, p; the other box has half sides `face`, and its face lies across axis `normal_axis`.
std::optional<Vector3d> aboveFace(const BoxFeature& feature, const Vector3d& half, const Matrix3d& R, const Vector3d& p,
                                  const Vector3d& face, int normal_axis) {
  const int u = (normal_axis + 1) % 3, v = (normal_axis + 2) % 3;
  const Vector3d center = p + R * feature.center;
  if (feature.dimension == 0) {
    if (std::abs(center[u]) > face[u] || std::abs(center[v]) > face[v]) return {};
    return center;
  }
  const auto side = [&](int i) -> Vector3d {
    return i < feature.dimension ? Vector3d(half[feature.free[i]] * R.col(feature.free[i])) : Vector3d::Zero();
  };
  const Vector3d x = side(0), y = side(1);
  ClippedFace polygon;
  polygon.corners = {center + x + y, center - x + y, center - x - y, center + x - y};
  polygon.size = 4;
  for (const int axis : {u, v}) {
    polygon.clip(axis, 1., face[axis]);
    polygon.clip(axis, -1., face[axis]);
  }
  if (polygon.size == 0) return {};
  return polygon.center();
}

/// The contact of two boxes along their axis of the widest gap.
struct BoxContact {
  Vector3d point_a;  ///< in the frame of a
  bool inside =
      true;  ///< false if the features miss each other along the axis; the axis is then not the nearest direction
};

BoxContact contactAlong(const BoxPair& pair, const SeparatingAxis& axis) {
  const BoxFeature on_a = farthest(pair.a, -axis.normal), on_b = farthest(pair.b, pair.R.transpose() * axis.normal);
  const Vector3d center_b = pair.p + pair.R * on_b.center;
  const auto across = [](const BoxFeature& face) { return 3 - face.free[0] - face.free[1]; };
  BoxContact contact{on_a.center, false};
  if (on_a.dimension == 2) {
    const auto found = aboveFace(on_b, pair.b, pair.R, pair.p, pair.a, across(on_a));
    contact.inside = found.has_value();
    contact.point_a = found.value_or(center_b) + axis.gap * axis.normal;
  } else if (on_b.dimension == 2) {
    const Matrix3d R = pair.R.transpose();
    const auto found = aboveFace(on_a, pair.a, R, -(R * pair.p), pair.b, across(on_b));
    contact.inside = found.has_value();
    if (found) contact.point_a = pair.p + pair.R * *found;
  } else if (on_a.dimension == 1 && on_b.dimension == 1) {
    const int i = on_a.free[0], j = on_b.free[0];
    const Vector3d u = Vector3d::Unit(i), v = pair.R.col(j), normal = u.cross(v), w = center_b - on_a.center;
    const double squared = normal.squaredNorm();
    const double s = w.cross(v).dot(normal) / squared, t = w.cross(u).dot(normal) / squared;
    const bool parallel = squared <= kParallel * kParallel;
    contact.inside = !parallel && std::abs(s) <= pair.a[i] && std::abs(t) <= pair.b[j];
    contact.point_a[i] = std::clamp(s, -pair.a[i], pair.a[i]);
  }
  return contact;
}

/// The nearest points if one of them is a corner.
struct CornerGap {
  Vector3d gap;      ///< from b to a
  Vector3d point_a;  ///< the middle of the equally near ones
};

CornerGap nearestCorners(const BoxPair& pair) {
  std::array<Vector3d, 16> gaps, points_a;
  for (int i = 0; i < 8; ++i) {
    const Vector3d signs(i & 1 ? 1. : -1., i & 2 ? 1. : -1., i & 4 ? 1. : -1.);
    points_a[i] = signs.cwiseProduct(pair.a);
    const Vector3d in_b = pair.R.transpose() * (points_a[i] - pair.p);
    gaps[i] = pair.R * (in_b - in_b.cwiseMax(-pair.b).cwiseMin(pair.b));
    const Vector3d corner_b = pair.p + pair.R * signs.cwiseProduct(pair.b);
    points_a[8 + i] = corner_b.cwiseMax(-pair.a).cwiseMin(pair.a);
    gaps[8 + i] = points_a[8 + i] - corner_b;
  }
  int best = 0;
  for (int i = 1; i < 16; ++i) {
    if (gaps[i].squaredNorm() < gaps[best].squaredNorm()) best = i;
  }
  Vector3d low = points_a[best], high = low;
  const double same = 2. * kParallel * pair.scale();
  for (int i = 0; i < 16; ++i) {
    if ((gaps[i] - gaps[best]).squaredNorm() > same * same) continue;
    low = low.cwiseMin(points_a[i]);
    high = high.cwiseMax(points_a[i]);
  }
  return {gaps[best], .5 * (low + high)};
}

/// The shortest of `gap` and the gaps from b to the edges of a. Slower than the axes, and exact at any angle.
Vector3d nearestEdgeGap(const BoxPair& pair, Vector3d gap) {
  const BoxCore b{{pair.R, pair.p}, pair.b};
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = 0; i < 4; ++i) {
      SegmentCore edge{Vector3d::Zero(), Vector3d::Unit(axis), pair.a[axis]};
      edge.center[u] = i & 1 ? pair.a[u] : -pair.a[u];
      edge.center[v] = i & 2 ? pair.a[v] : -pair.a[v];
      const NearestPoints near = segmentToBox(edge, b);
      if (near.distance * near.distance < gap.squaredNorm()) gap = near.distance * near.normal;
    }
  }
  return gap;
}

}  // namespace

NearestPoints boxToBox(const BoxCore& a, const BoxCore& b) {
  const Matrix3d R_AW = a.X_WB.R.transpose();
  const BoxPair pair{a.half, b.half, R_AW * b.X_WB.R, R_AW * (b.X_WB.p - a.X_WB.p)};
  SeparatingAxis axis = widestGap(pair);
  BoxContact contact = contactAlong(pair, axis);
  const bool ill_conditioned = nearlyParallel(pair);
  if (axis.gap > 0. && (!contact.inside || ill_conditioned)) {
    const CornerGap corner = nearestCorners(pair);
    if (!contact.inside) contact.point_a = corner.point_a;
    const Vector3d gap = ill_conditioned ? nearestEdgeGap(pair, corner.gap) : corner.gap;
    const double distance = gap.norm();
    if (distance > std::max(axis.gap, 1e-12 * pair.scale())) axis = {gap / distance, distance};
  }
  NearestPoints near;
  near.distance = axis.gap;
  near.normal = a.X_WB.R * axis.normal;
  near.point_a = a.X_WB * contact.point_a;
  near.point_b = near.point_a - near.distance * near.normal;
  return near;
}

}  // namespace kinegraph::inline geometry_internal
