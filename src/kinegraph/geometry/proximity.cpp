#include "kinegraph/geometry/proximity.h"

#include <coal/distance.h>

#include <algorithm>
#include <cmath>

#include "kinegraph/geometry/collision_body_convex.h"

namespace kinegraph {

namespace {

using Core = CollisionBody::Core;

/// A point of a segment core, at `s` in [-half, half] along its axis.
struct Segment {
  Vector3d center, axis;
  double half;
  Vector3d at(double s) const { return center + s * axis; }
};

Segment segmentOf(const CollisionBody& body, const RigidTransform& X) {
  return {X.p, X.R.col(2), body.core() == Core::segment ? body.halfLength() : 0.};
}

/// Nearest points of two segments. For parallel ones the middle of the stretch where they run side by side.
/// Source: Ericson, Real-Time Collision Detection, 5.1.9.
void nearestPoints(const Segment& a, const Segment& b, Vector3d& on_a, Vector3d& on_b) {
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

/// A unit vector across both axes: the normal where two cores meet in a point.
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

Proximity ofSegments(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b, const RigidTransform& X_WB) {
  const Segment segment_a = segmentOf(a, X_WA), segment_b = segmentOf(b, X_WB);
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

Proximity ofConvexes(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b, const RigidTransform& X_WB) {
  coal::DistanceRequest request;
  request.enable_signed_distance = true;
  request.gjk_tolerance = 1e-10;
  request.epa_tolerance = 1e-8;
  coal::DistanceResult result;
  const coal::Transform3s T_A(X_WA.R, X_WA.p), T_B(X_WB.R, X_WB.p);
  const double distance = coal::distance(a.convex().shape.get(), T_A, b.convex().shape.get(), T_B, request, result);
  const Vector3d core_a = result.nearest_points[0], core_b = result.nearest_points[1];
  const Vector3d gap = core_a - core_b;
  Vector3d normal = -result.normal;
  if (distance > 1e-7) normal = gap.normalized();
  if (!normal.allFinite() || normal.squaredNorm() < .5) {
    const Vector3d apart = X_WA * a.boundCenter() - X_WB * b.boundCenter();
    normal = apart.norm() > 1e-9 ? Vector3d(apart.normalized()) : Vector3d::UnitZ();
  }
  return fromCores(a, b, core_a, core_b, normal.normalized(), distance);
}

}  // namespace

Proximity proximity(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b, const RigidTransform& X_WB) {
  if (a.core() != Core::other && b.core() != Core::other) return ofSegments(a, X_WA, b, X_WB);
  return ofConvexes(a, X_WA, b, X_WB);
}

bool farApart(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b, const RigidTransform& X_WB,
              double margin) {
  const double reach = a.boundRadius() + b.boundRadius() + margin;
  return (X_WA * a.boundCenter() - X_WB * b.boundCenter()).squaredNorm() > reach * reach && reach >= 0.;
}

}  // namespace kinegraph
