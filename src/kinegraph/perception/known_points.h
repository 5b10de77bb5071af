#pragma once

#include <vector>

#include "kinegraph/perception/occupancy_map.h"

namespace kinegraph::inline perception_internal {

/// Whether a point is within a distance (m) of a shape.
bool isWithin(const KnownShape& shape, const Vector3d& point, double distance);

/// The share of some measured points that a camera could see only through shapes that do not move: its pose, or that
/// of the shapes, is wrong. Meshes, which may be hollow, and a shape around the camera do not count.
double shareBehind(const ObservedView& view, const std::vector<KnownShape>& known);

}  // namespace kinegraph::inline perception_internal
