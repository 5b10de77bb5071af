#pragma once

#include <memory>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/motion_plan.h"
#include "kinegraph/planning/plan_options.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline planning_internal {
class Planner;
}

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
/// first (planFromVelocity); if nothing can be timed so, without the acceleration, with a warning. In the same way, it
/// ends with options.end_velocity, and options.end_acceleration, at a goal of one configuration. Among
/// options.obstacle_trajectories, the timing avoids dynamic obstacles and waits if necessary (planAmongObstacles).
MotionPlan planMotion(const Config& config, const MotionGoal& goal, const PlanOptions& options = {},
                      const std::optional<VectorXd>& start = std::nullopt, const CancellationToken& cancellation = {});

/// A sequence of improving motions: the first is that of planMotion; each further one is shorter or takes less time
/// than the one before, as options.optimize says.
///
///     MotionPlans plans = planMotions(C, goal, {.margin = .01, .improvement_evaluations = 200000});
///     while (std::optional<MotionPlan> plan = plans.next()) C.viewPath(plan->path, plan->duration());
///
/// Further searches spend options.improvement_evaluations (1000000 if that is 0) in the part of the space that can
/// contain a shorter path. Equal arguments give equal motions at any number of threads, unless time_limit, counted from
/// the first call of `next`, ends the sequence.
class MotionPlans {
 public:
  /// Throws ValueError for invalid options, and for dynamic obstacles, start and end velocities, which only planMotion
  /// takes.
  MotionPlans(const Config& config, MotionGoal goal, PlanOptions options = {},
              const std::optional<VectorXd>& start = std::nullopt);
  ~MotionPlans();
  MotionPlans(const MotionPlans&) = delete;

  /// Returns the next motion. If there is no motion, the first plan says why. None after the last one.
  std::optional<MotionPlan> next(const CancellationToken& cancellation = {});

 private:
  const Config config_;
  const MotionGoal goal_;
  PlanOptions options_;
  const VectorXd start_;
  CancellationToken cancellation_, user_cancellation_;
  std::unique_ptr<Planner> planner_;  ///< constructed by the first call
};

/// Starts a sequence of improving motions; errors as the constructor.
MotionPlans planMotions(const Config& config, const MotionGoal& goal, const PlanOptions& options = {},
                        const std::optional<VectorXd>& start = std::nullopt);

}  // namespace kinegraph
