#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/motion_plan.h"
#include "kinegraph/planning/plan_options.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Plans a collision-free, time-parameterized motion from the start (none: the Config's q) to a goal.
///
///     MotionPlan plan = planMotion(C, MotionGoal({IkTarget::toPosition("hand", {.4, .2, .9})}), {.margin = .01});
///     if (plan.feasible()) C.viewPath(plan.path, plan.duration());
///
/// Stages: "endpoints" checks the start, samples goal configurations, and resolves slight contacts. "search" tries the
/// straight edge, then RRT-Connect. "shortcut" shortens several paths, of which the best one counts. "rope_shortcut"
/// tightens it around obstacles. "verify" checks every edge continuously. "timing" computes the fastest motion within
/// the limits of velocity, acceleration and jerk, and rounds corners as far as that is collision-free, too.
///
/// The Config is not changed. Equal arguments give equal bits at any number of threads, unless time_limit ends a stage.
/// Not finding a motion is a status with a message. Throws ValueError for invalid arguments.
///
/// With options.start_velocity, and options.start_acceleration, the motion begins with these and continues straight at
/// first (planFromVelocity). If nothing can be timed so, it begins without the acceleration, with a warning. Among
/// options.obstacle_trajectories, the timing avoids dynamic obstacles and waits if necessary (planAmongObstacles).
MotionPlan planMotion(const Config& config, const MotionGoal& goal, const PlanOptions& options = {},
                      const std::optional<VectorXd>& start = std::nullopt, const CancellationToken& cancellation = {});

}  // namespace kinegraph
