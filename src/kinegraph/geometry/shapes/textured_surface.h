#pragma once

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph {

/// The surface of a shape with a picture on it, which is repeated `repeat` times to the right and up. Meshes with
/// texture coordinates say themselves where it is. Otherwise it covers each side of a box, seen from outside with up
/// being z (y on top and below); a quad; balls, capsules and cylinders once around z; and the extent of anything else
/// from six sides. Without triangles where there is nothing to put it on.
Mesh texturedSurface(const Geometry& geometry, std::shared_ptr<const Image> image,
                     const std::array<double, 2>& repeat = {1., 1.});

/// The same with these texture coordinates: two for each vertex of its mesh.
std::shared_ptr<const Geometry> withTexcoords(const Geometry& geometry, const std::vector<double>& numbers);

}  // namespace kinegraph
