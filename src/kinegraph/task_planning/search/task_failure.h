#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/speculative_execution.h"
#include "kinegraph/logic/domain.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline task_planning_internal {

/// The cause for which a sequence of actions has no waypoints or no motion.
struct TaskFailure {
  std::string cause;
  std::shared_ptr<const Config> configuration;  ///< the scene at the waypoint that failed; null if there is none
  std::size_t action = 0;                       ///< index of the action without a motion
  std::vector<Literal> doors = {};              ///< facts about doors that block the motion: (closed drawer)
};

/// A failure whose cause is computed when it is requested, which takes as long as solving another waypoint problem.
/// Null: no failure.
using FutureFailure = std::shared_ptr<const Speculative<TaskFailure>>;

}  // namespace kinegraph::inline task_planning_internal
