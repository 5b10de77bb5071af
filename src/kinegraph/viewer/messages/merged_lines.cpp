#include "kinegraph/viewer/messages/merged_lines.h"

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace kinegraph::inline viewer_internal {

namespace {

using Color = std::array<std::uint8_t, 4>;
using Cell = std::pair<std::array<double, 3>, Color>;

/// The ends of lines in one cell.
struct Ends {
  Vector3d sum = Vector3d::Zero();
  double count = 0.;
};

}  // namespace

Mesh mergedLines(const Mesh& lines, double cell) {
  const bool has_colors = lines.colors.size() == lines.vertices.size();
  std::map<Cell, Ends> cells;
  std::vector<std::map<Cell, Ends>::const_iterator> ends;
  for (std::size_t i = 0; i < lines.vertices.size(); ++i) {
    const Vector3d at = (lines.vertices[i] / cell).array().round();
    const auto place =
        cells.try_emplace({{at.x(), at.y(), at.z()}, has_colors ? lines.colors[i] : Color{}}, Ends{}).first;
    place->second.sum += lines.vertices[i];
    place->second.count += 1.;
    ends.push_back(place);
  }
  Mesh merged;
  if (!has_colors) merged.colors = lines.colors;
  std::set<std::pair<const Ends*, const Ends*>> known;
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
    const Ends *a = &ends[i]->second, *b = &ends[i + 1]->second;
    if (a == b || !known.insert(std::minmax(a, b)).second) continue;
    for (const auto& end : {ends[i], ends[i + 1]}) {
      merged.vertices.push_back(end->second.sum / end->second.count);
      if (has_colors) merged.colors.push_back(end->first.second);
    }
  }
  return merged;
}

}  // namespace kinegraph::inline viewer_internal
