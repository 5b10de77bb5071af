#pragma once

#include <optional>

#include "kinegraph/geometry/distance/core_pair.h"

namespace kinegraph::inline geometry_internal {

/// The middle of the contact patch of two cores, in the frame of A, if parallel faces, edges, caps or side lines (to
/// within kParallel) make all of its points equally near. The patch is the farthest part of A along the unit vector m,
/// intersected along m with the farthest part of B in the opposite direction. Returns nullopt for a single nearest
/// point or patches that miss each other. Round caps count as polygons of 32 corners.
std::optional<Vector3d> middleOfContact(const CorePair& pair, const Vector3d& m);

}  // namespace kinegraph::inline geometry_internal
