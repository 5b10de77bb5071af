#pragma once

#include <optional>

#include "kinegraph/geometry/distance/core_pair.h"

namespace kinegraph {

/// The middle of the patch of A that is farthest along the unit vector m, seen along it over the patch of B that is
/// farthest the other way: where faces, edges, caps or side lines of two cores are parallel (to within kParallel), all
/// points of it are equally near. In the frame of A. Nothing where one point is, or the patches miss each other. Round
/// caps count as polygons of 32 corners.
std::optional<Vector3d> middleOfContact(const CorePair& pair, const Vector3d& m);

}  // namespace kinegraph
