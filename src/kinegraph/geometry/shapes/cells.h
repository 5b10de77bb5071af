#pragma once

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline geometry_internal {

/// The shape `cells`: the solid ones among equal cubes that fill a box.
inline constexpr ShapeType kCells = ShapeType(17);

/// The values of the grid of a `cells` shape, one for each cube. Occupied and unseen cells are solid.
struct CellKind {
  static constexpr float free = 0.f, occupied = 1.f, unseen = 2.f;
};

/// Throws ValueError for a grid without values, for other values than those of CellKind, and for cells that are not
/// cubes. `size` is that of the box, m.
void checkCells(const Grid& grid, const Vector3d& size);

/// The faces between solid cells and others, and at the sides of the box. Occupied cells are orange, unseen ones gray.
Mesh cellsSurface(const Grid& grid, const Vector3d& size);

}  // namespace kinegraph::inline geometry_internal
