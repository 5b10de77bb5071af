#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "kinegraph/scene/frame.h"

namespace kinegraph::inline task_planning_internal {

/// Returns vertices of the surface of a shape, in frame coordinates, m; none without a surface.
std::vector<Vector3d> shapePoints(const Frame& frame);

/// Returns the corners of a box around a shape, in frame coordinates, m; none without a shape.
std::vector<Vector3d> boxCorners(const Frame& frame);

/// Returns the box around shapePoints along the axes of the frame; empty without points.
Eigen::AlignedBox3d boxAround(const Frame& frame);

/// Whether things can stand on a shape: a box or a cylinder.
bool hasTop(const Frame& frame);

/// Returns the sides of a place along x and y, m; of a cylinder, those of the largest square on its top. Throws
/// ValueError for other shapes.
Eigen::Vector2d placeSides(const Frame& place);

/// Returns the diagonal of the first `count` sides of a place, m: twice the distance of its farthest points from its
/// center.
double diagonalOf(const Frame& frame, std::size_t count);

}  // namespace kinegraph::inline task_planning_internal
