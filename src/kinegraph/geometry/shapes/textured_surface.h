#pragma once

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline geometry_internal {

/// The surface of a shape covered by a picture, repeated `repeat` times to the right and up. Meshes with texture
/// coordinates use them. Otherwise the picture covers each side of a box, seen from outside with z up (y on top and
/// below); a quad; balls, capsules and cylinders once around z; and the extent of other shapes from six sides. Has no
/// triangles if there is no surface.
Mesh texturedSurface(const Geometry& geometry, std::shared_ptr<const Image> image,
                     const std::array<double, 2>& repeat = {1., 1.});

/// The geometry with these texture coordinates: two numbers per vertex of its mesh.
std::shared_ptr<const Geometry> withTexcoords(const Geometry& geometry, const std::vector<double>& numbers);

}  // namespace kinegraph::inline geometry_internal
