#pragma once

#include "kinegraph/geometry/distance/proximity.h"

namespace kinegraph::inline geometry_internal {

/// Proximity of a body to the half-space below the xy plane of a pose. The normal is the z axis of that pose, and the
/// distance is the height of the lowest point of the body; if a face or an edge of a box, segment or cylinder is
/// lowest, its middle is the witness point. Two half-spaces are infinitely far apart.
Proximity toHalfSpace(const CollisionBody& body, const RigidTransform& X_WB, const RigidTransform& X_WH);

}  // namespace kinegraph::inline geometry_internal
