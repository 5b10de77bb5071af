#pragma once

#include "kinegraph/geometry/distance/closed_form/nearest_points.h"
#include "kinegraph/geometry/distance/collision_body.h"

namespace kinegraph::inline geometry_internal {

/// Distance of a convex core a from a grid b: the least value of the grid's field (see GridField) on the core. Exact
/// for points. For other cores it is the least value found by descent from a few dozen points, so a field minimum
/// narrower than their spacing may be missed. The point on b is the zero of the field if it were a distance. The
/// distance changes by `rate`, the length of the field's gradient, per meter along the normal.
NearestPoints convexToGrid(const CollisionBody& core, const RigidTransform& X_WA, const CollisionBody& grid,
                           const RigidTransform& X_WB);

/// The point of a convex core nearest to a point, which may be inside. Local coordinates.
Vector3d nearestInCore(const CollisionBody& body, const Vector3d& point);

}  // namespace kinegraph::inline geometry_internal
