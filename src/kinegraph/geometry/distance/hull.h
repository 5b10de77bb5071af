#pragma once

#include "kinegraph/geometry/distance/collision_body.h"

namespace kinegraph {

/// The hull of one point or more, which may lie in a plane.
Hull makeHull(const std::vector<Vector3d>& points);

}  // namespace kinegraph
