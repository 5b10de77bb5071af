#include "kinegraph/kinematics/lane_model.h"

namespace kinegraph::inline kinematics_internal {

RunLanes laneKernel(int width) {
#ifdef KINEGRAPH_WIDE_LANES
  if (width == 8) return lanes::runRowsAvx512;
  if (width == 4) return lanes::runRowsAvx2;
#endif
  (void)width;
  return lanes::runRowsBase;
}

}  // namespace kinegraph::inline kinematics_internal
