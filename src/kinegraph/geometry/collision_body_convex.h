#pragma once

#include <coal/shape/geometric_shapes.h>

#include "kinegraph/geometry/collision_body.h"

namespace kinegraph {

/// Seen by collision_body.cpp and proximity.cpp only, which keeps coal out of everybody else's includes.
struct CollisionBody::Convex {
  std::unique_ptr<coal::CollisionGeometry> shape;
};

}  // namespace kinegraph
