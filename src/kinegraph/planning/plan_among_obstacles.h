#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/plan_from_velocity.h"

namespace kinegraph::inline planning_internal {

/// planMotion among the dynamic obstacles of options.obstacle_trajectories.
///
/// Plans a path among the static obstacles and a timing that avoids the dynamic ones (timeAmongObstacles). If the
/// timing fails or takes longer than the path alone, plans other paths: around the final places of the obstacles,
/// around all their places, and with other random numbers. The motion that arrives first counts. If there is none,
/// tries paths via refuges, configurations that no obstacle ever reaches, where the robot waits. The result is verified
/// continuously once more.
MotionPlan planAmongObstacles(const Config& config, const MotionGoal& goal, const PlanOptions& options,
                              const VectorXd& start, const CancellationToken& cancellation, const KnownCurves& known);

}  // namespace kinegraph::inline planning_internal
