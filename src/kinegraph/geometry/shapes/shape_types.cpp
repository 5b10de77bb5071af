#include "kinegraph/geometry/shapes/shape_types.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph {

namespace {

struct Kind {
  ShapeType type;
  const char* name;
  int entries;          ///< of size; 0 if it takes none
  const char* meaning;  ///< of the entries
};

/// What other formats call shapes.
constexpr std::pair<std::string_view, std::string_view> kWordsOfOthers[] = {
    {"cube", "box"},
    {"cuboid", "box"},
    {"block", "box"},
    {"ball", "sphere"},
    {"plane", "quad"},
    {"rectangle", "quad"},
    {"ellipsoid", "ssBoxElip with size: [0 0 0 rx ry rz 0]"},
    {"frame", "marker"},
    {"points", "pointCloud"},
    {"line", "lines"}};

constexpr Kind kKinds[] = {
    {ShapeType::box, "box", 3, "x y z"},
    {ShapeType::sphere, "sphere", 1, "radius"},
    {ShapeType::capsule, "capsule", 2, "length radius"},
    {ShapeType::mesh, "mesh", 0, ""},
    {ShapeType::cylinder, "cylinder", 2, "length radius"},
    {ShapeType::marker, "marker", 1, "length"},
    {ShapeType::pointCloud, "pointCloud", 0, ""},
    {ShapeType::ssCvx, "ssCvx", 1, "radius"},
    {ShapeType::ssBox, "ssBox", 4, "x y z radius"},
    {ShapeType::ssCylinder, "ssCylinder", 3, "length radius rounding"},
    {ShapeType::ssBoxElip, "ssBoxElip", 7, "x y z ex ey ez radius"},
    {ShapeType::quad, "quad", 2, "x y"},
    {ShapeType::camera, "camera", 0, ""},
    {ShapeType::sdf, "sdf", 3, "x y z"},
    {ShapeType::tensor, "tensor", 3, "x y z"},
    {ShapeType::lines, "lines", 0, ""},
};

const Kind& kindOf(ShapeType type) {
  for (const Kind& kind : kKinds) {
    if (kind.type == type) return kind;
  }
  throw ValueError(cat("shape type ", int(type), " does not exist"));
}

/// The counts that files of 2018 to 2023 have.
void modernize(ShapeType type, std::vector<double>& size) {
  const bool round = type == ShapeType::sphere || type == ShapeType::capsule || type == ShapeType::cylinder;
  if (round && size.size() == 4) size.erase(size.begin(), size.begin() + 2);
  if (type == ShapeType::sphere && size.size() == 2) size.erase(size.begin());
  if (type == ShapeType::box && size.size() == 4) size.pop_back();
  if (type == ShapeType::marker && size.size() > 1) size = {*std::max_element(size.begin(), size.end())};
  if (size.empty() && type == ShapeType::sphere) size = {1.};
  if (size.empty() && type == ShapeType::marker) size = {.1};
  if (kindOf(type).entries == 0) size.resize(type == ShapeType::camera ? std::min<std::size_t>(size.size(), 1) : 0);
}

}  // namespace

const std::vector<std::pair<std::string, ShapeType>>& shapeTypeNames() {
  static const std::vector<std::pair<std::string, ShapeType>> names = [] {
    std::vector<std::pair<std::string, ShapeType>> list;
    for (const Kind& kind : kKinds) list.emplace_back(kind.name, kind.type);
    return list;
  }();
  return names;
}

std::string shapeTypeName(ShapeType type) { return type == ShapeType::none ? "none" : kindOf(type).name; }

ShapeType shapeTypeFromName(std::string_view name) {
  const std::string_view word = name.starts_with("ST_") ? name.substr(3) : name;
  std::vector<std::string> words;
  for (const auto& [known, type] : shapeTypeNames()) {
    if (known == word) return type;
    words.push_back(known);
  }
  const auto meant = std::find_if(std::begin(kWordsOfOthers), std::end(kWordsOfOthers),
                                  [&](const auto& entry) { return entry.first == word; });
  const std::string hint = meant != std::end(kWordsOfOthers) ? cat("; what others call ", word, " is ", meant->second)
                                                             : similarHint(word, words);
  throw ValueError(cat("unknown shape type '", name, "'; expected one of ", join(words), hint));
}

std::vector<double> checkedSize(ShapeType type, std::vector<double> size, std::string* warning) {
  const std::size_t given = size.size();
  modernize(type, size);
  const Kind& kind = kindOf(type);
  if (size.size() != std::size_t(kind.entries) && type != ShapeType::camera) {
    throw ValueError(cat("size of a ", kind.name, " has ", kind.entries, " numbers [", kind.meaning, "], not ", given));
  }
  for (double x : size) {
    if (!std::isfinite(x) || x < 0.) {
      throw ValueError(cat("size of a ", kind.name, " has the entry ", x, "; lengths are finite and not negative"));
    }
  }
  if ((type == ShapeType::capsule || type == ShapeType::cylinder) && size[1] < 1e-10) {
    throw ValueError(cat("radius of a ", kind.name, " is ", size[1], "; it must be positive"));
  }
  if (type == ShapeType::ssBox) {
    for (int i = 0; i < 3; ++i) {
      if (size[i] >= 2. * size[3]) continue;
      if (warning)
        *warning = cat("ssBox with a side of ", size[i], " is thinner than twice its radius ", size[3],
                       "; enlarged to ", 2. * size[3]);
      size[i] = 2. * size[3];
    }
  }
  if (type == ShapeType::ssCylinder) {
    size[0] = std::max(size[0], 2. * size[2]);
    size[1] = std::max(size[1], size[2]);
  }
  return size;
}

}  // namespace kinegraph
