#pragma once

#include "kinegraph/geometry/distance/collision_body.h"
#include "kinegraph/geometry/distance/nearest_points.h"

namespace kinegraph {

/// Of two convex cores of any kind. Exact to rounding where they are apart, and where polytopes overlap; for
/// overlapping bent sides see `shortestPush`. Where an edge or a face is equally near all along, some point of it is
/// the witness. Source: Gilbert, Johnson & Keerthi, A fast procedure for computing the distance between complex
/// objects, 1988.
NearestPoints convexToConvex(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b,
                             const RigidTransform& X_WB);

}  // namespace kinegraph
