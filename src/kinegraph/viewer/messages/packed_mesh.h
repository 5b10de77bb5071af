#pragma once

#include <string>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline viewer_internal {

/// Encodes triangles in few bytes that compress well: positions on a grid, and each triangle by the edge that it shares
/// with a previous one. With `cell` > 0 (m), vertices of one color in a cube of that size are merged to their mean;
/// otherwise positions change by less than 1/60000 of the mesh's size. The order of triangles changes, and degenerate
/// triangles disappear. `mesh` needs triangles and finite vertices; its textures are omitted.
///
/// Layout: kind, number, vertices, triangles, colors (0 or one per vertex), symbols and references, as uint32; float32
/// origin (x, y, z) and grid step; then bytes. One symbol for each corner of a triangle without a shared edge and for
/// each edge on the stack: 0 no further triangle, 1 a new vertex, 2 a known one. For each known one, the number of
/// vertices since then, in 3 planes of bytes (all lowest ones first). For each vertex, the difference of its place on
/// the grid from the expected one, z(x) = 2x or -2x - 1, in 3 planes of all x, all y, all z. rgba in 4 planes.
std::string packMesh(int number, const Mesh& mesh, double cell = 0.);

}  // namespace kinegraph::inline viewer_internal
