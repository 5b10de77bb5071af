#include "kinegraph/kinematics/state_kernel.h"

namespace kinegraph::inline kinematics_internal {

UpdateState stateKernel() {
#ifdef KINEGRAPH_WIDE_LANES
  static const bool wide = __builtin_cpu_supports("avx2");
  if (wide) return lanes::updateStateAvx2;
#endif
  return lanes::updateStateBase;
}

}  // namespace kinegraph::inline kinematics_internal
