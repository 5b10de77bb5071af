#include "kinegraph/collision/edge_checkers.h"

#include <utility>

#include "kinegraph/kinematics/state.h"

namespace kinegraph::inline collision_internal {

std::unique_ptr<EdgeChecker> EdgeCheckers::take(const State& scene, double margin, double tolerance) {
  std::unique_ptr<EdgeChecker> checker;
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(free_, [&](const auto& one) {
      return one->scene().sharedModel() != scene.sharedModel() ||
             one->scene().sharedParameters() != scene.sharedParameters();
    });
    if (!free_.empty()) {
      checker = std::move(free_.back());
      free_.pop_back();
    }
  }
  if (!checker) return std::make_unique<EdgeChecker>(scene, margin, tolerance);
  checker->setMargin(margin);
  checker->setTolerance(tolerance);
  return checker;
}

void EdgeCheckers::giveBack(std::unique_ptr<EdgeChecker> checker) {
  const std::lock_guard lock(mutex_);
  free_.push_back(std::move(checker));
}

}  // namespace kinegraph::inline collision_internal
