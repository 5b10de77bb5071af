#pragma once

#include "kinegraph/geometry/distance/collision_body.h"

namespace kinegraph::inline geometry_internal {

/// The hull of at least one point; the points may lie in a plane. Sets `inner` to the radius (m) of a ball about
/// `center` within the hull, or 0 if there is none.
Hull makeHull(const std::vector<Vector3d>& points, const Vector3d& center, double& inner);

}  // namespace kinegraph::inline geometry_internal
