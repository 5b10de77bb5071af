#include "kinegraph/trajectories/jerk_limited_kernel.h"

#include "kinegraph/math/lane_widths.h"

namespace kinegraph::inline trajectories_internal {

const JerkLimitedKernel& jerkLimitedKernel(int width) {
  width = checkedLaneWidth(width);
#ifdef KINEGRAPH_WIDE_LANES
  if (width == 8) return lanes::kJerkLimitedKernelAvx512;
  if (width == 4) return lanes::kJerkLimitedKernelAvx2;
#endif
  return lanes::kJerkLimitedKernelBase;
}

}  // namespace kinegraph::inline trajectories_internal
