#include <algorithm>
#include <cmath>

#include "kinegraph/base/text.h"
#include "kinegraph/planning/ik_search.h"

namespace kinegraph {

IkResult IkSearch::solve(const std::vector<IkTarget>& targets, const IkCancel& cancel) {
  const IkOptions& options = problem_->options;
  setGoals(targets);
  evals_ = 0;
  IkResult result;
  double least = 1e300;  // cost of the answer kept, or what the best failure misses by
  VectorXd kept = x_;
  Outcome outcome = Outcome::missed;
  while (result.attempts < options.attempts && outcome != Outcome::cancelled) {
    if (cancel && cancel()) break;
    problem_->startingPoint(result.attempts++, x_.data());
    outcome = attempt(cancel);
    if (outcome == Outcome::feasible && problem_->pulls) outcome = bringNear(cancel);
    const bool better_kind = outcome == Outcome::feasible && !result.feasible;
    if (outcome != Outcome::feasible && result.feasible) continue;
    const double value = outcome == Outcome::feasible ? costOf(x_) : errors_.sum();
    if (!better_kind && value >= least) continue;
    least = value;
    kept = x_;
    result.feasible = outcome == Outcome::feasible;
    if (result.feasible && !options.best) break;
  }
  if (!result.feasible || options.best) {
    x_ = kept;
    measure();
    if (!result.feasible && result.attempts > 0) result.feasible = polish(cancel);
  }
  result.q = q_;
  result.position_error = errors_.position;
  result.rotation_error = errors_.rotation;
  result.penetration = errors_.penetration;
  result.evals = evals_;
  if (!result.feasible) result.message = explain(result.attempts);
  return result;
}

/// From a feasible x_ to the nearest one in its neighborhood.
IkSearch::Outcome IkSearch::bringNear(const IkCancel& cancel) {
  if (problem_->pairs.empty()) near_.clear();
  kept_ = x_;
  double least = costOf(x_), share = 1.;
  const auto keepIfBetter = [&] {
    if (!feasible() || costOf(x_) >= least) return false;
    least = costOf(x_);
    kept_ = x_;
    return true;
  };
  Outcome outcome = Outcome::feasible;
  for (int i = 0; i < 30 && outcome != Outcome::cancelled; ++i) {
    const double before = costOf(x_);
    pull_ = share * (problem_->nearest - x_);
    stepApart(pull_.data());
    const double moved = step_.step().lpNorm<Eigen::Infinity>();
    measure();
    keepIfBetter();
    if (moved < 1e-5) break;
    if (costOf(x_) > before) share = std::max(.5 * share, .05);
    if (cancel && cancel()) outcome = Outcome::cancelled;
  }
  if (outcome != Outcome::cancelled && !feasible() && moveApart(10, cancel) == Outcome::feasible) keepIfBetter();
  x_ = kept_;
  measure();
  return Outcome::feasible;
}

/// Lessens what the best failure misses by; true if that made it an answer.
bool IkSearch::polish(const IkCancel& cancel) {
  kept_ = x_;
  const double before = errors_.sum();
  if (moveApart(100, cancel) == Outcome::feasible) return true;
  if (errors_.sum() < before) return false;
  x_ = kept_;
  measure();
  return false;
}

std::string IkSearch::explain(int attempts) const {
  const Program& program = *problem_->program;
  const IkOptions& options = problem_->options;
  std::vector<std::string> reasons;
  for (std::size_t i = 0; i < goals_.size(); ++i) {
    const double position = std::sqrt(goals_[i].position_error), rotation = goals_[i].rotation_error;
    std::vector<std::string> misses;
    if (position > options.position_tolerance) misses.push_back(cat(position, " m"));
    if (rotation > options.rotation_tolerance) misses.push_back(cat(rotation, " rad"));
    if (!misses.empty()) reasons.push_back(cat("frame '", problem_->names[i], "' misses its target by ", join(misses, " and ")));
  }
  for (const NearPair& near : near_) {
    if (near.distance >= options.margin) continue;
    const auto [a, b] = problem_->pairs[near.pair];
    const std::string who = cat("frames '", program.frame_name[a], "' and '", program.frame_name[b], "' ");
    reasons.push_back(who + (options.margin == 0. ? cat("overlap by ", -near.distance, " m")
                                                  : cat("are ", near.distance, " m apart, less than the margin of ", options.margin, " m")));
  }
  for (int v = 0; v < problem_->variables(); ++v) {
    const bool low = x_[v] <= problem_->lower[v], high = x_[v] >= problem_->upper[v];
    if (!low && !high) continue;
    for (std::size_t f = 0; f < program.frame_dofs.size(); ++f) {
      const auto [first, count] = program.frame_dofs[f];
      if (problem_->dofs[v] < first || problem_->dofs[v] >= first + count) continue;
      reasons.push_back(cat("joint '", program.frame_name[f], "' is at its ", low ? "lower" : "upper", " limit ", x_[v]));
      break;
    }
  }
  return cat("no solution in ", attempts, attempts == 1 ? " attempt" : " attempts", "; at the nearest, ", join(reasons, "; "));
}

}  // namespace kinegraph
