#pragma once

#include "kinegraph/geometry/distance/collision_body.h"

namespace kinegraph::inline geometry_internal {

/// Distance of two bodies: distance = normal . (point_a - point_b). A small motion of the bodies changes it by
/// rate * normal . (velocity of point_a - velocity of point_b).
///
/// For overlapping convex bodies, -distance is the length of the shortest separating push. The distance of a compound
/// is the least over its parts; for grids see `convexToGrid`. The distance of two grids is the least distance of a
/// surface point of one from the other.
struct Proximity {
  double distance = 0.;                 ///< between the surfaces, m; negative: penetration depth
  Vector3d normal = Vector3d::UnitZ();  ///< unit, from b to a
  Vector3d point_a, point_b;            ///< witness points on the surfaces, world
  Vector3d core_a, core_b;              ///< witness points on the cores, world
  double core_distance = 0.;            ///< between the cores, m; negative if they overlap
  double rate = 1.;                     ///< 1 except for grids with values that are not distances
};

Proximity proximity(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b,
                    const RigidTransform& X_WB);

/// Squared distance of a point (world) from a body's core, m^2; 0 inside. Exact for points, segments, boxes and
/// cylinders; for others the squared distance from the bounding box, a lower bound.
double squaredPointToCore(const CollisionBody& body, const RigidTransform& X_WB, const Vector3d& point);

/// Returns whether a point (world) may be within `distance` of a body; false is certain. `distance` plus the body's
/// radius must not be negative.
inline bool mayBeWithin(const CollisionBody& body, const RigidTransform& X_WB, const Vector3d& point, double distance) {
  const double reach = body.radius() + distance;
  return squaredPointToCore(body, X_WB, point) <= reach * reach;
}

}  // namespace kinegraph::inline geometry_internal
