#pragma once

#include "kinegraph/geometry/distance/collision_body.h"
#include "kinegraph/geometry/distance/nearest_points.h"

namespace kinegraph {

/// Of a convex core a and a grid b: the least value of the grid's field (see GridField) on the core. Exact for points.
/// For other cores the least that is found from a few dozen points of the core by going downhill: a spike of the field
/// that is thinner than the gaps between them may be missed. The point on b is where the field would be zero if it were
/// a distance. The distance changes by `rate`, the length of the field's gradient, per meter along the normal.
NearestPoints convexToGrid(const CollisionBody& core, const RigidTransform& X_WA, const CollisionBody& grid,
                           const RigidTransform& X_WB);

/// The point of a convex core that is nearest to a point, which may be inside. Local coordinates.
Vector3d nearestInCore(const CollisionBody& body, const Vector3d& point);

}  // namespace kinegraph
