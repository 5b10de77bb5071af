#pragma once

#include <mutex>

#include "kinegraph/collision/edge_check.h"

namespace kinegraph {

/// EdgeCheckers of one scene that are kept between calls, as making one takes as long as a dozen answers. Threads may share
/// it; a copy keeps none.
class EdgeCheckers {
 public:
  EdgeCheckers() = default;
  EdgeCheckers(const EdgeCheckers&) {}
  EdgeCheckers& operator=(const EdgeCheckers&) { return *this; }

  /// One of this scene, as EdgeChecker's constructor makes it. Those of other scenes are dropped.
  std::unique_ptr<EdgeChecker> take(const State& scene, double margin, double tolerance = 1e-5);

  /// To be taken again.
  void giveBack(std::unique_ptr<EdgeChecker> checker);

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<EdgeChecker>> kept_;
};

}  // namespace kinegraph
