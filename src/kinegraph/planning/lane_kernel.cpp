#include "kinegraph/planning/lane_kernel.h"

namespace kinegraph {

LaneKernel chooseLaneKernel() {
#ifdef KINEGRAPH_WIDE_LANES
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) return {8, lanes::runAvx512};
  if (__builtin_cpu_supports("avx2")) return {4, lanes::runAvx2};
#endif
  return {2, lanes::runBase};
}

}  // namespace kinegraph
