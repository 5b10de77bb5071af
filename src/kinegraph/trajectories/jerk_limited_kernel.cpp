#include "kinegraph/trajectories/jerk_limited_kernel.h"

#include "kinegraph/math/lane_widths.h"

namespace kinegraph {

const JerkLimitedKernel& smoothKernel(int width) {
  width = checkedLaneWidth(width);
#ifdef KINEGRAPH_WIDE_LANES
  if (width == 8) return lanes::kSmoothKernelAvx512;
  if (width == 4) return lanes::kSmoothKernelAvx2;
#endif
  return lanes::kSmoothKernelBase;
}

}  // namespace kinegraph
