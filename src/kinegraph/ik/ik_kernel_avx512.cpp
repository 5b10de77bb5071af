namespace kinegraph::lanes {
namespace {
constexpr int kLanes = 8;
}
}  // namespace kinegraph::lanes

#include "kinegraph/ik/ik_kernel_body.h"

namespace kinegraph::lanes {

void runIkAvx512(const IkKernelModel& model, const IkKernelMemory& memory) { runIk(model, memory); }

}  // namespace kinegraph::lanes
