namespace kinegraph::lanes {
namespace {
constexpr int kLanes = 2;
}
}  // namespace kinegraph::lanes

#include "kinegraph/ik/ik_kernel_body.h"

namespace kinegraph::lanes {

void runIkBase(const IkKernelModel& model, const IkKernelMemory& memory) { runIk(model, memory); }

}  // namespace kinegraph::lanes
