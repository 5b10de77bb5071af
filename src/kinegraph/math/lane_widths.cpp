#include "kinegraph/math/lane_widths.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline math_internal {

const std::vector<int>& laneWidths() {
  static const std::vector<int> widths = [] {
    std::vector<int> list = {2};
#ifdef KINEGRAPH_WIDE_LANES
    if (__builtin_cpu_supports("avx2")) list.push_back(4);
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) list.push_back(8);
#endif
    return list;
  }();
  return widths;
}

int checkedLaneWidth(int width) {
  const std::vector<int>& widths = laneWidths();
  if (width == 0) return widths.back();
  if (std::ranges::find(widths, width) != widths.end()) return width;
  throw ValueError(cat("lanes: this machine has no registers for ", width,
                       " numbers; expected 0 for the widest, or one of ", widths.front(), " to ", widths.back()));
}

}  // namespace kinegraph::inline math_internal
