#pragma once

#include "kinegraph/geometry/distance/closed_form/nearest_points.h"
#include "kinegraph/geometry/distance/collision_body.h"

namespace kinegraph::inline geometry_internal {

/// Whether a body is a union of solid cells.
bool hasCells(const CollisionBody& body);

/// Nearest points of a convex core and the solid cells of a body, exact for separated cores. Distances of `most` (m) or
/// more may be given as `most` with other points. A core that overlaps solid cells is as deep as the deepest of its
/// extreme points and midpoints, or as its depth in one of the cells. Without solid cells the distance is 10 km.
NearestPoints convexToCells(const CollisionBody& core, const RigidTransform& X_WA, const CollisionBody& cells,
                            const RigidTransform& X_WB, double most = 1e4);

/// The distance of a convex body, its radius included, exact below `most` (m). Larger ones are given as `most`, mostly
/// by the bounds of the field alone.
double distanceToCells(const CollisionBody& convex, const RigidTransform& X_WA, const CollisionBody& cells,
                       const RigidTransform& X_WB, double most);

}  // namespace kinegraph::inline geometry_internal
