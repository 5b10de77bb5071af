#include "kinegraph/geometry/distance/proximity.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/geometry/distance/cell_distance.h"
#include "kinegraph/geometry/distance/cell_field.h"
#include "kinegraph/geometry/distance/closed_form/box_box_distance.h"
#include "kinegraph/geometry/distance/closed_form/cylinder_distance.h"
#include "kinegraph/geometry/distance/compound_distance.h"
#include "kinegraph/geometry/distance/convex_distance.h"
#include "kinegraph/geometry/distance/grid_distance.h"
#include "kinegraph/geometry/distance/grid_field.h"
#include "kinegraph/geometry/distance/half_space_distance.h"

namespace kinegraph::inline geometry_internal {

namespace {

using Core = CollisionBody::Core;

/// The core as a segment; a point becomes a segment of zero length.
SegmentCore segmentOf(const CollisionBody& body, const RigidTransform& X) {
  return {X.p, X.R.col(2), body.core() == Core::segment ? body.halfLength() : 0.};
}

/// Nearest points of two segments; for parallel ones the middle of their overlap.
/// Source: Ericson, Real-Time Collision Detection, 5.1.9.
void nearestPoints(const SegmentCore& a, const SegmentCore& b, Vector3d& on_a, Vector3d& on_b) {
  const Vector3d r = a.center - b.center;
  const double along = a.axis.dot(b.axis), ra = a.axis.dot(r), rb = b.axis.dot(r), denominator = 1. - along * along;
  const auto clampTo = [](double s, double half) { return std::clamp(s, -half, half); };
  double s = 0.;
  if (a.half > 0. && b.half > 0. && denominator > 1e-12) {
    s = clampTo((along * rb - ra) / denominator, a.half);
  } else if (a.half > 0. && b.half > 0.) {
    const double sign = along < 0. ? -1. : 1., middle = -ra;  // b covers [middle - half, middle + half] on a
    s = .5 * (std::max(-a.half, middle - b.half) + std::min(a.half, middle + b.half));
    s = clampTo(s, a.half);
    const double t = clampTo(sign * (s - middle), b.half);
    on_a = a.at(clampTo(middle + sign * t, a.half));
    on_b = b.at(t);
    return;
  } else {
    s = clampTo(-ra, a.half);
  }
  double t = along * s + rb;
  if (std::abs(t) > b.half) {
    t = clampTo(t, b.half);
    s = clampTo(along * t - ra, a.half);
  }
  on_a = a.at(s);
  on_b = b.at(t);
}

/// A unit vector perpendicular to both axes: the normal if two cores meet in a point.
Vector3d acrossBoth(const Vector3d& a, const Vector3d& b) {
  const Vector3d n = a.cross(b);
  if (n.norm() > 1e-9) return n.normalized();
  return a.unitOrthogonal();
}

Proximity fromCores(const CollisionBody& a, const CollisionBody& b, const Vector3d& core_a, const Vector3d& core_b,
                    const Vector3d& normal, double core_distance) {
  Proximity near;
  near.core_a = core_a;
  near.core_b = core_b;
  near.core_distance = core_distance;
  near.normal = normal;
  near.distance = core_distance - a.radius() - b.radius();
  near.point_a = core_a - a.radius() * normal;
  near.point_b = core_b + b.radius() * normal;
  return near;
}

Proximity ofSegments(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b,
                     const RigidTransform& X_WB) {
  const SegmentCore segment_a = segmentOf(a, X_WA), segment_b = segmentOf(b, X_WB);
  Vector3d core_a, core_b;
  nearestPoints(segment_a, segment_b, core_a, core_b);
  const Vector3d gap = core_a - core_b;
  const double distance = gap.norm();
  if (distance > 1e-10) return fromCores(a, b, core_a, core_b, gap / distance, distance);
  Vector3d normal = Vector3d::UnitZ();
  if (a.core() == Core::segment && b.core() == Core::segment) {
    normal = acrossBoth(segment_a.axis, segment_b.axis);
  } else if (a.core() == Core::segment || b.core() == Core::segment) {
    normal = (a.core() == Core::segment ? segment_a : segment_b).axis.unitOrthogonal();
  }
  return fromCores(a, b, core_a, core_b, normal, distance);
}

/// `a` may be a point, a segment or a box.
NearestPoints toBox(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b,
                    const RigidTransform& X_WB) {
  const BoxCore box{X_WB, b.halfSides()};
  switch (a.core()) {
    case Core::point:
      return pointToBox(X_WA.p, box);
    case Core::segment:
      return segmentToBox(segmentOf(a, X_WA), box);
    default:
      return boxToBox({X_WA, a.halfSides()}, box);
  }
}

}  // namespace

Proximity proximity(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b,
                    const RigidTransform& X_WB) {
  const auto isSegment = [](Core core) { return core == Core::point || core == Core::segment; };
  const auto fromNearest = [&](const NearestPoints& near) {
    Proximity proximity = fromCores(a, b, near.point_a, near.point_b, near.normal, near.distance);
    proximity.rate = near.rate;
    return proximity;
  };
  if (b.core() == Core::half_space) return toHalfSpace(a, X_WA, X_WB);
  if (a.core() == Core::half_space) {
    Proximity near = toHalfSpace(b, X_WB, X_WA);
    std::swap(near.point_a, near.point_b);
    std::swap(near.core_a, near.core_b);
    near.normal *= -1.;
    return near;
  }
  const bool small_a = isSegment(a.core()), small_b = isSegment(b.core());
  if (small_a && small_b) return ofSegments(a, X_WA, b, X_WB);
  if (b.core() == Core::box && (small_a || a.core() == Core::box)) return fromNearest(toBox(a, X_WA, b, X_WB));
  if (a.core() == Core::box && small_b) return fromNearest(toBox(b, X_WB, a, X_WA).swapped());
  if (a.core() == Core::point && b.core() == Core::cylinder) {
    return fromNearest(pointToCylinder(X_WA.p, {X_WB, b.coreRadius(), b.halfLength()}));
  }
  if (a.core() == Core::cylinder && b.core() == Core::point) {
    return fromNearest(pointToCylinder(X_WB.p, {X_WA, a.coreRadius(), a.halfLength()}).swapped());
  }
  if (a.convex() && b.convex()) return fromNearest(convexToConvex(a, X_WA, b, X_WB));
  if (a.convex() && b.core() == Core::grid) return fromNearest(convexToGrid(a, X_WA, b, X_WB));
  if (a.core() == Core::grid && b.convex()) return fromNearest(convexToGrid(b, X_WB, a, X_WA).swapped());
  return nearestParts(a, X_WA, b, X_WB);
}

double squaredPointToCore(const CollisionBody& body, const RigidTransform& X_WB, const Vector3d& point) {
  const Vector3d from_origin = point - X_WB.p;
  if (body.core() == Core::point) return from_origin.squaredNorm();
  const Vector3d p = X_WB.R.transpose() * from_origin;
  switch (body.core()) {
    case Core::segment:
      return p.head<2>().squaredNorm() + std::pow(std::max(std::abs(p.z()) - body.halfLength(), 0.), 2);
    case Core::box:
      return (p.cwiseAbs() - body.halfSides()).cwiseMax(0.).squaredNorm();
    case Core::cylinder:
      return std::pow(std::max(p.head<2>().norm() - body.coreRadius(), 0.), 2) +
             std::pow(std::max(std::abs(p.z()) - body.halfLength(), 0.), 2);
    case Core::grid:
      if (hasCells(body)) return std::pow(body.grid().cells->leastDistance(p), 2);
      [[fallthrough]];
    default:
      return ((p - body.boundCenter()).cwiseAbs() - body.boundHalf()).cwiseMax(0.).squaredNorm();
  }
}

}  // namespace kinegraph::inline geometry_internal
