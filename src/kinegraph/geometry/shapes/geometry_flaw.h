#pragma once

#include <string>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline geometry_internal {

/// Describes numbers of a geometry that contradict each other, such as a triangle whose corner does not exist. Returns
/// "" for a sound one. Throws ValueError for a type that does not exist.
std::string geometryFlaw(const Geometry& geometry);

}  // namespace kinegraph::inline geometry_internal
