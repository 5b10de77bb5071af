#pragma once

#include "kinegraph/geometry/collision_body.h"

namespace kinegraph {

/// How near two bodies are. distance = normal . (point_a - point_b), and a small motion of the bodies changes it by
/// normal . (velocity of point_a - velocity of point_b).
struct Proximity {
  double distance = 0.;                         ///< between the surfaces, m; negative: penetration depth
  Vector3d normal = Vector3d::UnitZ();          ///< unit, from b to a
  Vector3d point_a, point_b;                    ///< witness points on the surfaces, world
  Vector3d core_a, core_b;                      ///< witness points on the cores, world
  double core_distance = 0.;                    ///< between the cores, m; negative where they overlap
};

Proximity proximity(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b, const RigidTransform& X_WB);

/// Distance of a point (world) from a body's core, m: 0 inside; for hulls a lower bound.
double pointToCore(const CollisionBody& body, const RigidTransform& X_WB, const Vector3d& point);

}  // namespace kinegraph
