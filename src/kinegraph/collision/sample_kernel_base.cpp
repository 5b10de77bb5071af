namespace kinegraph::lanes {
namespace {
constexpr int kLanes = 2;
}
}  // namespace kinegraph::lanes

#include "kinegraph/collision/sample_kernel_body.h"

namespace kinegraph::lanes {

const SampleKernel kSampleKernelBase = kKernel;

}  // namespace kinegraph::lanes
