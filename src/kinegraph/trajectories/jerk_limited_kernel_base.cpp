namespace kinegraph::lanes {
namespace {
constexpr int kLanes = 2;
}
}  // namespace kinegraph::lanes

#include "kinegraph/trajectories/jerk_limited_kernel_body.h"

namespace kinegraph::lanes {

const JerkLimitedKernel kJerkLimitedKernelBase = kKernel;

}  // namespace kinegraph::lanes
