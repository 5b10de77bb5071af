namespace kinegraph::lanes {
namespace {
constexpr int kLanes = 4;
}
}  // namespace kinegraph::lanes

#include "kinegraph/kinematics/lane_kernel_body.h"

namespace kinegraph::lanes {

void runRowsAvx2(const LaneModel& model, const LaneRows& rows, const LaneMemory& memory, const LaneBatch& batch) {
  runRows(model, rows, memory, batch);
}

}  // namespace kinegraph::lanes
