#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/endpoints.h"
#include "kinegraph/planning/plan_options.h"
#include "kinegraph/planning/search/path_search.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// The postures that a goal stands for.
struct GoalConfigurations {
  std::vector<Endpoint> ends;  ///< one at least, in the order in which they were given or found; not all are free
  bool was_reached = true;     ///< false: the goal is out of reach, and `message` says by how much
  std::string message;
};

/// Throws ValueError for a goal that makes no sense, FrameNotFound and NameError for names that are not there.
GoalConfigurations goalConfigurations(const Config& config, const MotionGoal& goal, const VectorXd& start,
                                      Steering& steering, const PlanOptions& options,
                                      const CancellationToken& cancellation);

}  // namespace kinegraph
