namespace kinegraph::lanes {
namespace {
constexpr int kLanes = 8;
}
}  // namespace kinegraph::lanes

#include "kinegraph/trajectories/jerk_limited_kernel_body.h"

namespace kinegraph::lanes {

const JerkLimitedKernel kJerkLimitedKernelAvx512 = kKernel;

}  // namespace kinegraph::lanes
