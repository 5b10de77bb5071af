#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/plan_from_velocity.h"

namespace kinegraph {

/// planMotion among obstacles of which options.obstacle_trajectories says how they move.
///
/// A way is planned among what stands still, and timed such that it meets no moving obstacle (timeAmongObstacles). Where
/// that takes longer than the way alone, or cannot be, other ways are planned: around where obstacles will be in the
/// end, around all places where they ever are, and with other random numbers. The one that arrives first counts. Where
/// there is none, ways by postures to which no obstacle comes are tried: the robot steps aside, and waits there. The
/// motion is checked at all times once more.
MotionPlan planAmongObstacles(const Config& config, const MotionGoal& goal, const PlanOptions& options,
                              const VectorXd& start, const CancellationToken& cancellation, const KnownCurves& known);

}  // namespace kinegraph
