#pragma once

#include <memory>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/plan_motion.h"

namespace kinegraph {

class Planner;

/// Motions that get better while one waits: the first is that of planMotion, each further one is shorter, or takes less
/// time, than the one before, as options.optimize says.
///
///     MotionPlans plans = planMotions(C, goal, {.margin = .01, .improve = 200000});
///     while (std::optional<MotionPlan> plan = plans.next()) C.viewPath(plan->path, plan->duration());
///
/// Further ways are searched with options.improvement_evaluations evaluations (1000000 if that is 0), where a shorter one can be. The
/// same arguments give the same motions, at any number of threads, unless time_limit, counted from the first call on,
/// ends it.
class MotionPlans {
 public:
  /// Throws ValueError for what makes no sense, and for moving obstacles and start velocities, which planMotion knows.
  MotionPlans(const Config& config, MotionGoal goal, PlanOptions options = {},
              const std::optional<VectorXd>& start = std::nullopt);
  ~MotionPlans();
  MotionPlans(const MotionPlans&) = delete;

  /// The next motion; where there is none, the first one says why. None after the last one.
  std::optional<MotionPlan> next(const CancellationToken& cancellation = {});

 private:
  const Config config_;
  const MotionGoal goal_;
  PlanOptions options_;
  const VectorXd start_;
  CancellationToken cancellation_, user_cancellation_;
  std::unique_ptr<Planner> planner_;  ///< made by the first call
};

MotionPlans planMotions(const Config& config, const MotionGoal& goal, const PlanOptions& options = {},
                        const std::optional<VectorXd>& start = std::nullopt);

}  // namespace kinegraph
