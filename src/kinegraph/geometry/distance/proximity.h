#pragma once

#include "kinegraph/geometry/distance/collision_body.h"

namespace kinegraph {

/// How near two bodies are. distance = normal . (point_a - point_b), and a small motion of the bodies changes it by
/// rate * normal . (velocity of point_a - velocity of point_b).
///
/// For convex bodies a negative distance is minus the length of the shortest push that parts them. The distance of a
/// compound is the least of its parts'; for grids see `convexToGrid`; of two grids, the least of the points of one's
/// surface from the other.
struct Proximity {
  double distance = 0.;                 ///< between the surfaces, m; negative: penetration depth
  Vector3d normal = Vector3d::UnitZ();  ///< unit, from b to a
  Vector3d point_a, point_b;            ///< witness points on the surfaces, world
  Vector3d core_a, core_b;              ///< witness points on the cores, world
  double core_distance = 0.;            ///< between the cores, m; negative where they overlap
  double rate = 1.;                     ///< 1 but for grids, whose values may grow by more or less than distances
};

Proximity proximity(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b,
                    const RigidTransform& X_WB);

/// Square of the distance of a point (world) from a body's core, m^2: 0 inside. Exact for points, segments, boxes and
/// cylinders; for others that from the bounding box, a lower bound.
double squaredPointToCore(const CollisionBody& body, const RigidTransform& X_WB, const Vector3d& point);

/// May a point (world) be nearer to a body than `distance`, or that near? False is certain. The sum of the distance and
/// the body's radius must not be negative.
inline bool mayBeWithin(const CollisionBody& body, const RigidTransform& X_WB, const Vector3d& point, double distance) {
  const double reach = body.radius() + distance;
  return squaredPointToCore(body, X_WB, point) <= reach * reach;
}

}  // namespace kinegraph
