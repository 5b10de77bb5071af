#include "kinegraph/planning/plan_motion.h"

#include "kinegraph/planning/planner.h"

namespace kinegraph {

namespace {

constexpr int kDefaultImprovement = 1000000;  // evaluations

}  // namespace

MotionPlans::MotionPlans(const Config& config, MotionGoal goal, PlanOptions options,
                         const std::optional<VectorXd>& start)
    : config_(config),
      goal_(std::move(goal)),
      options_(std::move(options)),
      start_(start.value_or(config_.getJointState())),
      user_cancellation_([this] { return cancellation_ && cancellation_(); }) {
  options_.validateFor(config_.getJointDimension());
  if (!options_.obstacle_trajectories.empty() ||
      (options_.start_velocity.size() > 0 && !options_.start_velocity.isZero(0.)) ||
      (options_.end_velocity.size() > 0 && !options_.end_velocity.isZero(0.)))
    throw ValueError(
        "planMotions: obstacle_trajectories, start_velocity and end_velocity are not supported; call planMotion");
  if (options_.improvement_evaluations == 0) options_.improvement_evaluations = kDefaultImprovement;
}

MotionPlans::~MotionPlans() = default;

std::optional<MotionPlan> MotionPlans::next(const CancellationToken& cancellation) {
  cancellation_ = cancellation;
  std::optional<MotionPlan> plan;
  if (planner_) {
    plan = planner_->better();
  } else {
    planner_ = std::make_unique<Planner>(config_, options_, user_cancellation_);
    plan = planner_->run(goal_, start_);
  }
  cancellation_ = {};
  if (plan) plan->options = options_;
  return plan;
}

MotionPlans planMotions(const Config& config, const MotionGoal& goal, const PlanOptions& options,
                        const std::optional<VectorXd>& start) {
  return MotionPlans(config, goal, options, start);
}

}  // namespace kinegraph
