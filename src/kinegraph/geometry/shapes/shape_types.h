#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline geometry_internal {

/// All shape types except `none`, with their names in files.
const std::vector<std::pair<std::string, ShapeType>>& shapeTypeNames();
std::string shapeTypeName(ShapeType type);

/// The type of that name, with or without the prefix "ST_". Throws ValueError with the valid and the most similar
/// names.
ShapeType shapeTypeFromName(std::string_view name);

/// Returns the sizes of a shape as `Geometry` stores them. Accepts the counts of older files: four entries [0 0 length
/// radius] for sphere, capsule and cylinder, a fourth entry of a box, several entries of a marker, a sphere without
/// size (radius 1), a marker without size (0.1). Enlarges a rounded box thinner than its rounding. Reports that, and a
/// radius that a box does not use, in `warning`, if given. Throws ValueError for other counts and for numbers that are
/// negative or not finite.
std::vector<double> checkedSize(ShapeType type, std::vector<double> size, std::string* warning);

}  // namespace kinegraph::inline geometry_internal
