#include "kinegraph/solvers/algebra/band_layout.h"

#include <algorithm>
#include <numeric>

namespace kinegraph::inline solvers_internal {

namespace {

/// Whether the row has the same columns as the one before.
bool repeatsColumns(const Jacobian& pattern, int row) {
  if (row == 0) return false;
  const auto segments = pattern.row_segments(row), before = pattern.row_segments(row - 1);
  return std::equal(segments.begin(), segments.end(), before.begin(), before.end(),
                    [](const Jacobian::Segment& a, const Jacobian::Segment& b) {
                      return a.column == b.column && a.width == b.width;
                    });
}

}  // namespace

BandLayout bandLayout(int variables, const Jacobian& pattern) {
  std::vector<int> reach(std::size_t(variables), 0);
  for (int row = 0; row < pattern.rows(); ++row) {
    if (repeatsColumns(pattern, row)) continue;
    const auto segments = pattern.row_segments(row);
    int last = 0;
    for (const Jacobian::Segment& segment : segments) last = std::max(last, segment.column + segment.width - 1);
    for (const Jacobian::Segment& segment : segments) {
      for (int i = segment.column; i < segment.column + segment.width; ++i) reach[i] = std::max(reach[i], last - i);
    }
  }
  std::vector<int> sorted = reach;
  std::nth_element(sorted.begin(), sorted.begin() + variables / 2, sorted.end());
  const int usual = variables > 0 ? 4 * sorted[variables / 2] + 16 : 0;
  BandLayout layout{std::vector<int>(std::size_t(variables)), 0};
  for (int i = 0; i < variables; ++i) layout.shared += reach[i] > usual;
  int next = 0, next_shared = variables - layout.shared;
  for (int i = 0; i < variables; ++i) layout.place[i] = reach[i] > usual ? next_shared++ : next++;
  return layout;
}

BandedMatrix bandedMatrix(const BandLayout& layout, const Jacobian& pattern) {
  const int band = int(layout.place.size()) - layout.shared;
  std::vector<int> last(static_cast<std::size_t>(band));
  std::iota(last.begin(), last.end(), 0);
  for (int row = 0; row < pattern.rows(); ++row) {
    if (repeatsColumns(pattern, row)) continue;
    int lowest = 0;
    const auto forPlaces = [&](const auto& visit) {
      for (const Jacobian::Segment& segment : pattern.row_segments(row)) {
        for (int i = segment.column; i < segment.column + segment.width; ++i) {
          if (layout.place[i] < band) visit(layout.place[i]);
        }
      }
    };
    forPlaces([&](int place) { lowest = std::max(lowest, place); });
    forPlaces([&](int place) { last[place] = std::max(last[place], lowest); });
  }
  return BandedMatrix(std::move(last), layout.shared);
}

}  // namespace kinegraph::inline solvers_internal
