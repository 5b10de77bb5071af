namespace kinegraph::lanes {
namespace {
constexpr int kLanes = 2;
}
}  // namespace kinegraph::lanes

#include "kinegraph/planning/lane_kernel_body.h"

namespace kinegraph::lanes {

void runBase(const LaneModel& model, const LaneMemory& memory) {
  placeLinks(model, memory);
  measure(model, memory);
  step(model, memory);
}

}  // namespace kinegraph::lanes
