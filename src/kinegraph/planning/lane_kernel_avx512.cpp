namespace kinegraph::lanes {
namespace {
constexpr int kLanes = 8;
}
}  // namespace kinegraph::lanes

#include "kinegraph/planning/lane_kernel_body.h"

namespace kinegraph::lanes {

void runAvx512(const LaneModel& model, const LaneMemory& memory) {
  placeLinks(model, memory);
  measure(model, memory);
  step(model, memory);
}

}  // namespace kinegraph::lanes
