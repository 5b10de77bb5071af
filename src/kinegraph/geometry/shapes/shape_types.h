#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph {

/// All shape types but `none`, with the words that files use.
const std::vector<std::pair<std::string, ShapeType>>& shapeTypeNames();
std::string shapeTypeName(ShapeType type);

/// The type of that name, with or without the prefix "ST_". Throws ValueError with the legal and the nearest words.
ShapeType shapeTypeFromName(std::string_view name);

/// The sizes of a shape as `Geometry` wants them. Accepts the counts of older files: four entries [0 0 length radius]
/// for sphere, capsule and cylinder, a fourth entry of a box, more than one of a marker, a sphere without size (radius
/// 1), a marker without (0.1). A rounded box thinner than its rounding is enlarged, and `warning` (if given) says so.
/// Throws ValueError for other counts and for numbers that are negative or not finite.
std::vector<double> checkedSize(ShapeType type, std::vector<double> size, std::string* warning);

}  // namespace kinegraph
