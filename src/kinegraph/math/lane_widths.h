#pragma once

#include <vector>

namespace kinegraph::inline math_internal {

/// Returns the numbers of problems that kernels process in parallel lanes, ascending, for the instruction sets of this
/// machine: 2 always, 4 with AVX2, 8 with AVX-512. All widths give the same bits.
const std::vector<int>& laneWidths();
constexpr int kMostLanes = 8;

/// Returns `width`, or the widest one for 0. Throws ValueError unless it is one of laneWidths().
int checkedLaneWidth(int width);

}  // namespace kinegraph::inline math_internal
