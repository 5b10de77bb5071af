#pragma once

#include "kinegraph/geometry/geometry.h"

namespace kinegraph {

/// The convex hull of points as a closed mesh with outward triangles. Throws ValueError for fewer than four points or
/// points in one plane.
Mesh convexHull(const std::vector<Vector3d>& points);

}  // namespace kinegraph
