#include "kinegraph/planning/plan_goals.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/ik/ik_problem.h"
#include "kinegraph/kinematics/kinematic_model.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr double kSame = .05;  // closer configurations count as one goal, in joint space
constexpr int kSamplesPerGoal = 4;

class GoalFinder {
 public:
  GoalFinder(const Config& config, const VectorXd& start, Steering& steering, const PlanOptions& options,
             const CancellationToken& cancellation)
      : config_(config), steering_(steering), options_(options), cancellation_(cancellation), start_(start) {}

  GoalConfigurations of(const MotionGoal& goal) {
    const int kinds =
        !goal.configurations.empty() + !goal.targets.empty() + !goal.conditions.empty() + !goal.state.empty();
    if (kinds != 1)
      throw ValueError(cat(kPlanMotion, ": the goal ", kinds ? "has several kinds" : "is empty",
                           "; expected one of joint vectors, targets, conditions, or the name of a joint state"));
    if (!goal.state.empty()) add(config_.getNamedState(goal.state), cat("goal '", goal.state, "'"));
    for (std::size_t i = 0; i < goal.configurations.size(); ++i)
      add(goal.configurations[i], goal.configurations.size() == 1 ? "goal" : cat("goal ", i));
    if (!goal.targets.empty()) fromTargets(goal.targets);
    if (!goal.conditions.empty()) fromConditions(goal.conditions);
    return std::move(found_);
  }

 private:
  void add(const VectorXd& q, const std::string& what) {
    found_.ends.push_back(checkEndpoint(steering_, *config_.model(), q, options_.margin, what, kPlanMotion));
  }

  bool isNew(const VectorXd& q) const {
    return std::ranges::none_of(found_.ends,
                                [&](const Endpoint& end) { return steering_.space().distance(end.q, q) < kSame; });
  }

  bool hasEnough() const {
    return int(found_.ends.size()) >= options_.max_goal_samples || (cancellation_ && cancellation_());
  }

  void requireFrames(const IkTarget& target) const {
    std::vector<std::string> names = target.feature ? target.feature->frames : std::vector{target.frame};
    if (!target.relative_to.empty()) names.push_back(target.relative_to);
    for (const std::string& name : names) frameId(*config_.model(), name, kPlanMotion);
  }

  /// Solves inverse kinematics from the start, and from random values of the joints that move the targets.
  void fromTargets(const std::vector<IkTarget>& targets) {
    steering_.space().requireRanges(kPlanMotion);
    for (const IkTarget& target : targets) requireFrames(target);
    Config scene(config_);
    scene.setJointState(start_);
    IkOptions ik;
    ik.margin = options_.margin + 2. * Clearance::kGuard;
    ik.max_start_penetration = options_.max_start_penetration;
    ik.seed = options_.seed;
    const IkProblem problem(scene, targets, ik);
    const std::vector<int>& dofs = problem.dofs;
    found_.question = problem.question;
    Rng rng(options_.seed);
    std::string failure;
    for (int i = 0; i < kSamplesPerGoal * options_.max_goal_samples && !hasEnough(); ++i) {
      if (i > 0) {
        const VectorXd sampled = steering_.space().sample(rng, start_);
        VectorXd from = start_;
        for (const int dof : dofs) from[dof] = sampled[dof];
        scene.setJointState(from);
        ik.attempts = 4;
      }
      const IkResult result = solveIk(scene, targets, ik);
      if (result.feasible() && !isNew(result.q)) continue;
      if (result.feasible()) {
        add(result.q, "goal");
      } else if (failure.empty()) {
        failure = result.message;
        if (i == 0) break;  // after 100 attempts of solveIk
      }
    }
    if (found_.ends.empty()) {
      found_.was_reached = false;
      found_.message = cat("the goal is out of reach: ", failure);
    }
  }

  /// Projects the start and random configurations onto the conditions.
  void fromConditions(std::vector<MotionConstraint> conditions) {
    steering_.space().requireRanges(kPlanMotion);
    conditions.insert(conditions.end(), options_.constraints.begin(), options_.constraints.end());
    Manifold manifold(config_.state(), steering_.space(), conditions, options_.constraint_tolerance);
    Rng rng(options_.seed);
    double least = std::numeric_limits<double>::infinity();
    std::string missed;
    std::vector<Endpoint> blocked;
    for (int i = 0; i < 8 * kSamplesPerGoal * options_.max_goal_samples && !hasEnough(); ++i) {
      VectorXd q = i == 0 ? start_ : steering_.space().sample(rng, start_);
      if (!manifold.project(q)) {
        const double violation = manifold.violation(q);
        if (violation < least) missed = manifold.worst(q);
        least = std::min(least, violation);
      } else if (isNew(q)) {
        add(q, "goal");
        if (found_.ends.back().isFree()) continue;
        blocked.push_back(std::move(found_.ends.back()));
        found_.ends.pop_back();
      }
    }
    if (!found_.ends.empty()) return;
    if (!blocked.empty()) {
      found_.ends = {std::move(blocked.front())};
      return;
    }
    found_.was_reached = false;
    found_.message = cat("the goal is out of reach: ", "the least violation of ", missed, " is ", least);
  }

  const Config& config_;
  Steering& steering_;
  const PlanOptions& options_;
  const CancellationToken& cancellation_;
  const VectorXd start_;
  GoalConfigurations found_;
};

}  // namespace

GoalConfigurations goalConfigurations(const Config& config, const MotionGoal& goal, const VectorXd& start,
                                      Steering& steering, const PlanOptions& options,
                                      const CancellationToken& cancellation) {
  return GoalFinder(config, start, steering, options, cancellation).of(goal);
}

}  // namespace kinegraph::inline planning_internal
