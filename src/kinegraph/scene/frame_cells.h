#pragma once

#include "kinegraph/scene/frame.h"

namespace kinegraph {

/// Sets the shape to the solid cubes of a grid of cells, in a box of that size (m). A value of 0 is a free cell, 1 an
/// occupied one, 2 one that no camera has seen (CellKind); the last two are solid. Throws ValueError for an invalid
/// grid or size, and for cells that are not cubes.
void setCells(Frame& frame, Grid grid, const Vector3d& size);

}  // namespace kinegraph
