#pragma once

#include <vector>

namespace kinegraph {

/// How many problems the kernels in lanes do side by side, per instruction set: 2 on every machine, 4 with AVX2, 8 with
/// AVX-512. In ascending order, only what this machine runs. All widths give the same bits.
const std::vector<int>& laneWidths();
constexpr int kMostLanes = 8;

/// `width` where it is one of laneWidths(), the widest for 0. Throws ValueError for another one.
int checkedLaneWidth(int width);

}  // namespace kinegraph
