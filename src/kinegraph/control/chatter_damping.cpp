#include "kinegraph/control/chatter_damping.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline control_internal {

namespace {

constexpr double kSmallest = 1e-6;  // rad or m, of steps that count
constexpr double kFirst = 1., kLargest = 16., kGrowth = 4.;
constexpr double kFading = .9;  // per step of a joint that keeps its direction

}  // namespace

void ChatterDamping::add(const VectorXd& change) {
  moved_ = change.norm() > kSmallest ? change.norm() : 0.;
  for (Eigen::Index j = 0; j < change.size(); ++j) {
    const double now = change[j], size = std::abs(now);
    if (size <= kSmallest) continue;  // at rest the damping stays: the next step would jump again
    const bool takes_back = now * before_[j] < 0. && size > .5 * std::abs(before_[j]);
    damping_[j] = takes_back ? std::clamp(kGrowth * damping_[j], kFirst, kLargest) : kFading * damping_[j];
    before_[j] = now;
  }
}

}  // namespace kinegraph::inline control_internal
