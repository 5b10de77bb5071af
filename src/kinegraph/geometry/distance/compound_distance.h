#pragma once

#include "kinegraph/geometry/distance/proximity.h"

namespace kinegraph {

/// The least distance among the parts of a and b, of which one is a compound, or both are grids: a body that is convex
/// is its own only part, and so is a grid, which meets another grid by the points of its surface. Parts whose bounding
/// spheres show that they are farther apart than others are not looked at.
Proximity nearestParts(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b,
                       const RigidTransform& X_WB);

}  // namespace kinegraph
