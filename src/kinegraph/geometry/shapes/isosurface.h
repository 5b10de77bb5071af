#pragma once

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph {

/// The surface where the values of a grid are zero, as triangles whose normals point to larger values; the grid fills a
/// box of that size (m) centered at the origin. Every vertex lies on an edge between two grid points, where linear
/// interpolation is zero. Closed where the surface does not leave the box. Throws ValueError for a grid whose numbers
/// do not fit. Source: Doi & Koide, An efficient method of triangulating equi-valued surfaces by using tetrahedral
/// cells, 1991.
Mesh isosurface(const Grid& grid, const Vector3d& size);

/// Each value replaced by the mean of those at most one step away along every axis, `times` times.
Grid blurred(Grid grid, int times);

/// The grid with another number of points per axis, interpolated linearly.
Grid resampled(const Grid& grid, const std::array<int, 3>& cells);

/// Throws ValueError unless the grid has at least 2 points per axis and as many finite values as that takes.
void checkGrid(const Grid& grid);

}  // namespace kinegraph
