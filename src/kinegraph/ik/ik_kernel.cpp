#include "kinegraph/ik/ik_kernel.h"

namespace kinegraph::inline ik_internal {

IkKernel ikKernel(int width) {
#ifdef KINEGRAPH_WIDE_LANES
  if (width == 8) return {8, lanes::runIkAvx512};
  if (width == 4) return {4, lanes::runIkAvx2};
#endif
  (void)width;
  return {2, lanes::runIkBase};
}

}  // namespace kinegraph::inline ik_internal
