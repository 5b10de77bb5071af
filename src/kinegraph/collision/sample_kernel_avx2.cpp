namespace kinegraph::lanes {
namespace {
constexpr int kLanes = 4;
}
}  // namespace kinegraph::lanes

#include "kinegraph/collision/sample_kernel_body.h"

namespace kinegraph::lanes {

const SampleKernel kSampleKernelAvx2 = kKernel;

}  // namespace kinegraph::lanes
