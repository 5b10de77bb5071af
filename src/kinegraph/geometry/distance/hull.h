#pragma once

#include "kinegraph/geometry/distance/collision_body.h"

namespace kinegraph {

/// The hull of one point or more, which may lie in a plane. `inner` becomes the radius of a ball about `center` that is
/// within the hull, m; 0 where none is.
Hull makeHull(const std::vector<Vector3d>& points, const Vector3d& center, double& inner);

}  // namespace kinegraph
