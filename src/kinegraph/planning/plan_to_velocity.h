#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/motion_plan.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline planning_internal {

/// planMotion among static obstacles from rest to options.end_velocity (not zero) and end_acceleration. The end of a
/// motion to rest is bent (arriveMoving). If that cannot be, it is planFromVelocity from the goal with the opposite
/// velocity, reversed in time: the motion ends straight, or with a ramp of its acceleration; if nothing can be timed
/// so, without the acceleration, with a warning. Throws ValueError if the goal is not one configuration.
MotionPlan planToVelocity(const Config& config, const MotionGoal& goal, const PlanOptions& options,
                          const VectorXd& start, const CancellationToken& cancellation);

}  // namespace kinegraph::inline planning_internal
