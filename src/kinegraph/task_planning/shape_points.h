#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "kinegraph/scene/frame.h"

namespace kinegraph {

/// Vertices of a shape's surface, in the frame's coordinates, m; none without a surface.
std::vector<Vector3d> shapePoints(const Frame& frame);

/// The box around them, along the frame's axes; empty without any.
Eigen::AlignedBox3d boxAround(const Frame& frame);

/// The sides of a place along its x and y, m: its first two sizes. Throws ValueError for shapes that have fewer.
Eigen::Vector2d placeSides(const Frame& place);

/// Of the first `count` sizes of a shape, m: half of it is how far a corner of a box is from its middle.
double diagonalOf(const Frame& frame, std::size_t count);

}  // namespace kinegraph
