#pragma once

#include <mutex>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/kinematics/state.h"

namespace kinegraph::inline collision_internal {

/// A pool of EdgeCheckers of one scene: constructing one takes as long as a dozen checks. Threads may share the pool; a
/// copy is empty.
class EdgeCheckers {
 public:
  EdgeCheckers() = default;
  EdgeCheckers(const EdgeCheckers&) {}
  EdgeCheckers& operator=(const EdgeCheckers&) { return *this; }

  /// Takes a checker of this scene out of the pool, or constructs one. Drops those of other scenes.
  std::unique_ptr<EdgeChecker> take(const State& scene, double margin, double tolerance = 1e-5);

  /// Returns a checker to the pool.
  void giveBack(std::unique_ptr<EdgeChecker> checker);

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<EdgeChecker>> free_;
};

}  // namespace kinegraph::inline collision_internal
