#pragma once

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// Where two convex cores are nearest, in world coordinates: point_a - point_b = distance * normal, with the unit
/// normal from b to a. Where the cores overlap, -distance is the length of the shortest push that parts them. Where a
/// stretch or a face is equally near (parallel to within kParallel), the points are in its middle.
struct NearestPoints {
  double distance = 0.;
  Vector3d normal = Vector3d::UnitZ();
  Vector3d point_a = Vector3d::Zero(), point_b = Vector3d::Zero();
  double rate = 1.;  ///< by how much `distance` changes per meter along the normal: 1 but for grids

  NearestPoints swapped() const { return {distance, -normal, point_b, point_a, rate}; }
};

/// Sine of the angle below which directions count as parallel when points are chosen among equally near ones. It is
/// above the steps of finite differences, which then see no jump; distances and normals are exact all the same.
inline constexpr double kParallel = 2e-6;

}  // namespace kinegraph
