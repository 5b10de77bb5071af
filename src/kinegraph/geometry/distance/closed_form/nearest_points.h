#pragma once

#include "kinegraph/math/pose.h"

namespace kinegraph::inline geometry_internal {

/// Nearest points of two convex cores, in world coordinates: point_a - point_b = distance * normal, with the unit
/// normal from b to a. For overlapping cores, -distance is the length of the shortest separating push. If a line or a
/// face is equally near (parallel to within kParallel), the points are in its middle.
struct NearestPoints {
  double distance = 0.;
  Vector3d normal = Vector3d::UnitZ();
  Vector3d point_a = Vector3d::Zero(), point_b = Vector3d::Zero();
  double rate = 1.;  ///< change of `distance` per meter along the normal: 1 except for grids

  NearestPoints swapped() const { return {distance, -normal, point_b, point_a, rate}; }
};

/// Sine of the angle below which directions count as parallel when a point is chosen among equally near ones. It
/// exceeds the steps of finite differences, so they see no jump; distances and normals stay exact.
inline constexpr double kParallel = 2e-6;

}  // namespace kinegraph::inline geometry_internal
