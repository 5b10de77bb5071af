#pragma once

#include "kinegraph/geometry/distance/closed_form/nearest_points.h"
#include "kinegraph/geometry/distance/collision_body.h"

namespace kinegraph::inline geometry_internal {

/// Nearest points of two convex cores of any kind. Exact to rounding for separated cores and overlapping polytopes; for
/// overlapping curved cores see `shortestPush`. If an edge or a face is equally near, some point of it is the witness.
/// Source: Gilbert, Johnson & Keerthi, A fast procedure for computing the distance between complex objects, 1988.
NearestPoints convexToConvex(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b,
                             const RigidTransform& X_WB);

}  // namespace kinegraph::inline geometry_internal
