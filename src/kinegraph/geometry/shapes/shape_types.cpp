#include "kinegraph/geometry/shapes/shape_types.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"

namespace kinegraph::inline geometry_internal {

namespace {

/// Shape names of other formats, with the name used here.
constexpr std::pair<std::string_view, std::string_view> kForeignNames[] = {
    {"cube", "box"},
    {"cuboid", "box"},
    {"block", "box"},
    {"ball", "sphere"},
    {"halfspace", "plane"},
    {"rectangle", "quad"},
    {"ellipsoid", "ssBoxElip with size: [0 0 0 rx ry rz 0]"},
    {"frame", "marker"},
    {"points", "pointCloud"},
    {"line", "lines"}};

}  // namespace

const std::vector<std::pair<std::string, ShapeType>>& shapeTypeNames() {
  static const std::vector<std::pair<std::string, ShapeType>> names = [] {
    std::vector<std::pair<std::string, ShapeType>> list;
    for (const ShapeKind& kind : shapeKinds()) list.emplace_back(std::string(kind.name), kind.type);
    return list;
  }();
  return names;
}

std::string shapeTypeName(ShapeType type) { return std::string(shapeKind(type).name); }

ShapeType shapeTypeFromName(std::string_view name) {
  const std::string_view word = name.starts_with("ST_") ? name.substr(3) : name;
  std::vector<std::string> names;
  for (const auto& [known, type] : shapeTypeNames()) {
    if (known == word) return type;
    names.push_back(known);
  }
  const auto meant = std::find_if(std::begin(kForeignNames), std::end(kForeignNames),
                                  [&](const auto& entry) { return entry.first == word; });
  const std::string hint = meant != std::end(kForeignNames)
                               ? cat("; the shape ", word, " of other formats is ", meant->second)
                               : similarHint(word, names);
  throw ValueError(cat("unknown shape type '", name, "'; expected one of ", join(names), hint));
}

std::vector<double> checkedSize(ShapeType type, std::vector<double> size, std::string* warning) {
  const std::size_t given = size.size();
  if (type == ShapeType::none) throw ValueError(cat("shape type ", int(type), " does not exist"));
  const ShapeKind& kind = shapeKind(type);
  if (warning && type == ShapeType::box && given == 4 && size[3] != 0.)
    *warning = cat("a box has no rounding, so its fourth number ", size[3], " is not used; an ssBox has rounded edges");
  if (kind.modernize) kind.modernize(size);
  if (kind.sizes() == 0) size.resize(std::min(size.size(), kind.optional_sizes));
  if (size.size() != kind.sizes() && kind.sizes() > 0) {
    throw ValueError(
        cat("size of a ", kind.name, " has ", kind.sizes(), " numbers [", kind.size_names, "], not ", given));
  }
  for (double x : size) {
    if (!std::isfinite(x) || x < 0.) {
      throw ValueError(cat("size of a ", kind.name, " has the entry ", x, "; expected finite lengths >= 0"));
    }
  }
  const std::string repaired = kind.repair ? kind.repair(size) : "";
  if (warning && !repaired.empty()) *warning = repaired;
  return size;
}

}  // namespace kinegraph::inline geometry_internal
