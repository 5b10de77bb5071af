#pragma once

#include <memory>

#include "kinegraph/geometry/distance/collision_body.h"

namespace kinegraph::inline geometry_internal {

/// Returns what makeCollisionBody returns. Geometries with the same mesh and equal sizes, such as the visual and
/// the collision shape of one file, share their body while it is in use. Thread-safe.
std::shared_ptr<const CollisionBody> sharedCollisionBody(const Geometry& geometry);

/// Returns whether the body of these points exists already, so that sharedCollisionBody takes no time.
bool hasSharedBody(const Geometry& geometry);

}  // namespace kinegraph::inline geometry_internal
