#pragma once

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline geometry_internal {

/// Returns whether the points are not coplanar, by more than 1e-9 of their extent. Throws ValueError for non-finite
/// coordinates.
bool spanVolume(const std::vector<Vector3d>& points);

/// The convex hull of points as a closed mesh with outward triangles. Throws ValueError for fewer than four points,
/// coplanar points and non-finite coordinates.
Mesh convexHull(const std::vector<Vector3d>& points);

}  // namespace kinegraph::inline geometry_internal
