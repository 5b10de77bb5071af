#include "kinegraph/planning/plan_to_velocity.h"

#include <chrono>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/planning/arrive_moving.h"
#include "kinegraph/planning/plan_from_velocity.h"
#include "kinegraph/planning/plan_timing.h"
#include "kinegraph/planning/steering/joint_space.h"
#include "kinegraph/trajectories/curve_part.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr double kFewTimes = 2., kLittleMore = 1.;  // s: of a motion to rest; a longer one is planned in another way

/// The options of the motion in the other direction.
PlanOptions backwards(const PlanOptions& options) {
  PlanOptions back = options;
  back.start_velocity = -options.end_velocity;
  back.start_acceleration = options.end_acceleration;
  back.end_velocity = back.end_acceleration = {};
  return back;
}

MotionPlan reversedPlan(MotionPlan plan) {
  plan.path = plan.path.colwise().reverse().eval();
  plan.raw_path = plan.raw_path.colwise().reverse().eval();
  plan.timed_path = reversed(plan.timed_path);
  if (plan.trees.size() == 2) std::swap(plan.trees[0], plan.trees[1]);
  for (SearchReport& search : plan.searches) std::swap(search.start_nodes, search.goal_nodes);
  return plan;
}

/// Describes the first end velocity or acceleration beyond its limit; "" if there is none.
std::string beyondLimit(const Config& config, const PlanOptions& options) {
  const MotionLimits limits = limitsFromStart(planLimits(config, options), backwards(options));
  const JointSpace space(*config.model());
  const std::tuple<const char*, const VectorXd*, const VectorXd*> both[] = {
      {"velocity", &options.end_velocity, &limits.velocity},
      {"acceleration", &options.end_acceleration, &limits.acceleration}};
  for (const auto& [what, values, limit] : both)
    for (Eigen::Index j = 0; j < values->size(); ++j)
      if (std::abs((*values)[j]) > (*limit)[j])
        return cat("the end ", what, " of ", space.nameOf(int(j)), " is ", (*values)[j], "; its limit is ",
                   (*limit)[j]);
  return "";
}

}  // namespace

MotionPlan planToVelocity(const Config& config, const MotionGoal& goal, const PlanOptions& options,
                          const VectorXd& start, const CancellationToken& cancellation) {
  if (goal.configurations.size() != 1) throw ValueError("planMotion: end_velocity needs a goal of one configuration");
  const VectorXd& end = goal.configurations[0];
  const Eigen::Index dofs = config.getJointDimension();
  if (end.size() != dofs || start.size() != dofs) return planFromVelocity(config, goal, options, start, cancellation);
  MotionPlan plan;
  if (plan.message = beyondLimit(config, options); !plan.message.empty()) {
    plan.status = PlanStatus::invalid_goal;
    return plan;
  }
  const auto began = std::chrono::steady_clock::now();
  const auto timeLeft = [&] {
    return options.timeLeft(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
  };
  PlanOptions to_rest = options;
  to_rest.end_velocity = to_rest.end_acceleration = {};
  MotionPlan at_rest = planFromVelocity(config, goal, to_rest, start, cancellation);
  if (!at_rest.feasible()) return at_rest;
  std::optional<MotionPlan> moving = arriveMoving(config, at_rest, options, cancellation);
  if (moving && moving->duration() < kFewTimes * at_rest.duration() + kLittleMore) return std::move(*moving);
  PlanOptions back = backwards(options);
  back.time_limit = timeLeft();
  plan = planFromVelocity(config, MotionGoal(start), back, end, cancellation);
  if (plan.status == PlanStatus::no_path_found && back.start_acceleration.size() > 0) {
    back.start_acceleration = {};
    back.time_limit = timeLeft();
    MotionPlan other = planFromVelocity(config, MotionGoal(start), back, end, cancellation);
    if (other.feasible()) {
      plan = std::move(other);
      plan.warnings.push_back("the motion ends without the end acceleration");
    }
  }
  if (moving && !(plan.feasible() && plan.duration() < moving->duration())) return std::move(*moving);
  if (plan.feasible()) return reversedPlan(std::move(plan));
  if (plan.status == PlanStatus::timeout || plan.status == PlanStatus::cancelled) return plan;
  MotionPlan failed;
  failed.status = PlanStatus::no_path_found;
  failed.message = cat("a motion ends there at rest, but none with the end velocity; back in time: ", plan.message);
  failed.stages = std::move(plan.stages);
  failed.scene = plan.scene, failed.space = plan.space;
  return failed;
}

}  // namespace kinegraph::inline planning_internal
