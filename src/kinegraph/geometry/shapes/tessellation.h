#pragma once

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline geometry_internal {

/// The surface of a shape as outward, closed triangles (a quad: two triangles). Shapes without a surface (marker,
/// camera, point clouds, lines) give an empty mesh; a mesh gives itself.
Mesh tessellate(const Geometry& geometry);

}  // namespace kinegraph::inline geometry_internal
