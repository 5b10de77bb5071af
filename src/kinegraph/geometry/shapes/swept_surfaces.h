#pragma once

#include <functional>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline geometry_internal {

/// A box with half sides `half` swept by a ball of radius r. Closed and outward, as all meshes here.
Mesh roundedBox(const Vector3d& half, double r);

/// A cylinder of outer length and radius with edges rounded by r.
Mesh roundedCylinder(double length, double radius, double r);

/// The hull of points swept by a convex shape, given by its support function.
Mesh sweptHull(const std::vector<Vector3d>& core, const std::function<Vector3d(const Vector3d&)>& support);

std::vector<Vector3d> boxCorners(const Vector3d& half);

}  // namespace kinegraph::inline geometry_internal
