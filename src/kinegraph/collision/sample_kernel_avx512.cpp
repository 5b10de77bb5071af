namespace kinegraph::lanes {
namespace {
constexpr int kLanes = 8;
}
}  // namespace kinegraph::lanes

#include "kinegraph/collision/sample_kernel_body.h"

namespace kinegraph::lanes {

const SampleKernel kSampleKernelAvx512 = kKernel;

}  // namespace kinegraph::lanes
