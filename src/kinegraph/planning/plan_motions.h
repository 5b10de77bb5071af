#pragma once

#include <memory>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/plan_motion.h"

namespace kinegraph {

class Planner;

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
  /// Throws ValueError for invalid options, and for dynamic obstacles and start velocities, which only planMotion
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
