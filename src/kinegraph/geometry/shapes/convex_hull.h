#pragma once

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph {

/// Whether points do not all lie in a plane, by more than 1e-9 of their extent. Throws ValueError for coordinates that
/// are not finite.
bool spanVolume(const std::vector<Vector3d>& points);

/// The convex hull of points as a closed mesh with outward triangles. Throws ValueError for fewer than four points,
/// points in one plane and coordinates that are not finite.
Mesh convexHull(const std::vector<Vector3d>& points);

}  // namespace kinegraph
