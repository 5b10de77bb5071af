#include "kinegraph/collision/sample_kernel.h"

#include "kinegraph/math/lane_widths.h"

namespace kinegraph::inline collision_internal {

const SampleKernel& sampleKernel(int width) {
  width = checkedLaneWidth(width);
#ifdef KINEGRAPH_WIDE_LANES
  if (width == 8) return lanes::kSampleKernelAvx512;
  if (width == 4) return lanes::kSampleKernelAvx2;
#endif
  return lanes::kSampleKernelBase;
}

}  // namespace kinegraph::inline collision_internal
