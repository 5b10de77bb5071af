#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/motion_plan.h"
#include "kinegraph/planning/plan_options.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// A motion from the start (none: the Config's q) to a goal, free of collisions at all times, and when it is where.
///
///     MotionPlan plan = planMotion(C, MotionGoal({IkTarget::toPosition("hand", {.4, .2, .9})}), {.margin = .01});
///     if (plan.feasible()) C.viewPath(plan.path, plan.duration());
///
/// Stages: the ends are looked at (goal postures are found, and contacts mended that are slight); a way is searched, the
/// straight one first, then by trees; it is shortened, several times from different ways, and the best one counts, which
/// is pulled taut; every straight motion of it is verified at all times; it is timed within limits of velocity, acceleration and jerk, where
/// corners are rounded as far as that is free, too. The Config is not changed. The same arguments give the same bits,
/// at any number of threads, unless time_limit cuts it off. Finding no motion is a status with a message. Throws
/// ValueError for what makes no sense.
///
/// With options.start_velocity, and options.start_acceleration, the motion begins with these, and goes straight on at first
/// (planFromVelocity). Where nothing can be timed so, it begins without the acceleration, and a note says so.
/// Among options.obstacle_trajectories, the times keep it clear of what moves, and it waits where it has to (planAmongObstacles).
MotionPlan planMotion(const Config& config, const MotionGoal& goal, const PlanOptions& options = {},
                      const std::optional<VectorXd>& start = std::nullopt, const CancellationToken& cancellation = {});

}  // namespace kinegraph
