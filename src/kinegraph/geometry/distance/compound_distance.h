#pragma once

#include "kinegraph/geometry/distance/proximity.h"

namespace kinegraph::inline geometry_internal {

/// The least distance among the parts of a and b, if one is a compound or both are grids. A convex body or a grid is
/// its own only part; a grid meets another grid by the points of its surface. Bounding spheres exclude distant parts.
Proximity nearestParts(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b,
                       const RigidTransform& X_WB);

}  // namespace kinegraph::inline geometry_internal
