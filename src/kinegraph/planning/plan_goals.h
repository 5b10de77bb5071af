#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/endpoints.h"
#include "kinegraph/planning/plan_options.h"
#include "kinegraph/planning/search/path_search.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline planning_internal {

/// The configurations of a goal.
struct GoalConfigurations {
  std::vector<Endpoint> ends;  ///< at least one, as passed or in the order of sampling; some may be in collision
  bool was_reached = true;     ///< false: the goal is out of reach; `message` says why
  std::string message;
  std::string question;  ///< about a target that seems to be in the order x y z w
};

/// Checks the goal configurations, or samples them for targets and conditions. Throws ValueError for an invalid goal,
/// FrameNotFound and NameError for unknown names.
GoalConfigurations goalConfigurations(const Config& config, const MotionGoal& goal, const VectorXd& start,
                                      Steering& steering, const PlanOptions& options,
                                      const CancellationToken& cancellation);

}  // namespace kinegraph::inline planning_internal
