#include "kinegraph/ik/ik_diagnosis.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/ik/target_questions.h"

namespace kinegraph::inline ik_internal {

namespace {

constexpr double kTouching = 1e-3;   // m beyond the margin: pairs that are reported as colliding
constexpr double kLeastPush = 1e-3;  // m, rad: reported limits would gain at least this much per unit of error
constexpr std::size_t kPairsNamed = 3;

std::vector<std::string> missedTargets(const IkProblem& problem, const IkJob& job) {
  const IkOptions& options = problem.options;
  std::vector<std::string> reasons;
  for (std::size_t i = 0; i < job.goals.size(); ++i) {
    const IkTask& task = problem.tasks[i];
    const IkGoal& goal = job.goals[i];
    std::vector<std::string> amounts;
    if (goal.position_error > options.position_tolerance) amounts.push_back(cat(goal.position_error, " m"));
    if (goal.rotation_error > options.rotation_tolerance) amounts.push_back(cat(goal.rotation_error, " rad"));
    if (task.residual && goal.feature_error > task.target.feature->tolerance)
      amounts.push_back(cat(goal.feature_error, task.unitOf(goal.worst_component)));
    if (amounts.empty()) continue;
    reasons.push_back(cat(task.name(), " misses its ", task.goal(), " by ", join(amounts, " and ")));
    const std::string question = askAboutLength(goal.relative.p, goal.position_error);
    if (!question.empty()) reasons.push_back(question);
  }
  return reasons;
}

std::string pairName(const IkProblem& problem, int pair) {
  const auto [a, b] = problem.pairs[pair];
  return cat("'", problem.model->frame_name[a], "' and '", problem.model->frame_name[b], "'");
}

/// The worst pairs.
std::vector<std::string> collidingPairs(const IkProblem& problem, const IkIterate& iterate) {
  using NearPair = IkIterate::NearPair;
  const double margin = problem.options.margin;
  std::vector<NearPair> worst;
  std::ranges::copy_if(iterate.nearPairs(), std::back_inserter(worst),
                       [&](const NearPair& near) { return near.distance < margin + kTouching; });
  std::ranges::sort(worst, {}, &NearPair::distance);
  std::vector<std::string> reasons;
  for (std::size_t i = 0; i < std::min(worst.size(), kPairsNamed); ++i) {
    const double distance = worst[i].distance;
    const std::string how = distance < 0. ? cat("overlap by ", -distance, " m") : cat("are ", distance, " m apart");
    const std::string needed = margin == 0. ? "" : cat(" (the margin is ", margin, " m)");
    reasons.push_back(cat("frames ", pairName(problem, worst[i].pair), " ", how, needed));
  }
  if (worst.size() > kPairsNamed) reasons.push_back(cat("and ", worst.size() - kPairsNamed, " more pairs"));
  return reasons;
}

/// Joints at limits against which the targets and the near pairs push them.
std::vector<std::string> bindingLimits(const IkProblem& problem, IkIterate& iterate) {
  const VectorXd push = iterate.descentDirection();
  const VectorXd& x = iterate.x();
  const double least = kLeastPush * std::sqrt(iterate.squaredError());
  std::vector<std::string> reasons;
  for (int v = 0; v < problem.variables(); ++v) {
    const bool low = x[v] <= problem.lower[v] && push[v] < -least, high = x[v] >= problem.upper[v] && push[v] > least;
    if (!low && !high) continue;
    reasons.push_back(cat("joint '", jointName(*problem.model, problem.dofs[v]), "' is at its ",
                          low ? "lower" : "upper", " limit ", x[v]));
  }
  return reasons;
}

}  // namespace

std::string describeFailure(const IkProblem& problem, const IkJob& job, IkIterate& iterate) {
  const int attempts = job.attempts;
  std::string text =
      cat(job.cancelled ? "cancelled after " : "no solution in ", attempts, attempts == 1 ? " attempt" : " attempts");
  const auto most = std::ranges::max_element(job.blocked);
  if (most != job.blocked.end() && *most > 0) {
    int reached = 0;
    for (int count : job.blocked) reached += count;
    text += cat("; ", reached, " reached the targets in collision, most often of ",
                pairName(problem, int(most - job.blocked.begin())));
  }
  if (attempts == 0) return text;
  std::vector<std::string> reasons = missedTargets(problem, job);
  for (const std::string& reason : collidingPairs(problem, iterate)) reasons.push_back(reason);
  for (const std::string& reason : bindingLimits(problem, iterate)) reasons.push_back(reason);
  return cat(text, "; at the nearest, ", join(reasons, "; "));
}

}  // namespace kinegraph::inline ik_internal
