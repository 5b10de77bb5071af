#pragma once

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline geometry_internal {

/// Extracts the zero level set of a grid as triangles with normals to larger values; the grid fills a box of that size
/// (m) centered at the origin. Every vertex lies on an edge between two grid points, at the zero of the linear
/// interpolation. The surface is closed unless it leaves the box. Throws ValueError for an invalid grid. Source: Doi &
/// Koide, An efficient method of triangulating equi-valued surfaces by using tetrahedral cells, 1991.
Mesh isosurface(const Grid& grid, const Vector3d& size);

/// Replaces each value by the mean of its 3 x 3 x 3 neighborhood, `times` times.
Grid blurred(Grid grid, int times);

/// Resamples the grid to another number of points per axis by linear interpolation.
Grid resampled(const Grid& grid, const std::array<int, 3>& cells);

/// Throws ValueError unless the grid has at least 2 points per axis and the matching number of finite values.
void checkGrid(const Grid& grid);

}  // namespace kinegraph::inline geometry_internal
