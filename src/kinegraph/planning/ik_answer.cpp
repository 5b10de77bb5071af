#include <algorithm>
#include <cmath>

#include "kinegraph/base/text.h"
#include "kinegraph/planning/ik_search.h"

namespace kinegraph {

namespace {

constexpr double kTouching = 1e-3;  // m beyond the margin: pairs that are named as in the way
constexpr double kLeastPush = 1e-3;  // m, rad: what a limit that is named would gain per unit of what is missed
constexpr std::size_t kPairsNamed = 3;

const char* kindName(IkTarget::Kind kind) {
  switch (kind) {
    case IkTarget::Kind::pose: return "pose";
    case IkTarget::Kind::position: return "position";
    case IkTarget::Kind::rotation: return "rotation";
    case IkTarget::Kind::direction: return "direction";
  }
  return "target";
}

}  // namespace

IkResult IkSearch::solve(const std::vector<IkTarget>& targets, const Stop& stop) {
  const IkOptions& options = problem_->options;
  setGoals(targets);
  std::fill(blocked_.begin(), blocked_.end(), 0);
  evals_ = 0;
  IkResult result;
  bool feasible = false;
  double least = 1e300;  // cost of the answer kept, or what the best failure misses by
  problem_->startingPoint(0, x_.data());
  VectorXd kept = x_;
  Outcome outcome = Outcome::missed;
  while (result.attempts < options.attempts && outcome != Outcome::cancelled) {
    if (stop()) {
      outcome = Outcome::cancelled;
      break;
    }
    problem_->startingPoint(result.attempts++, x_.data());
    outcome = attempt(stop);
    if (outcome == Outcome::feasible && problem_->pulls) outcome = bringNear(stop);
    if (outcome != Outcome::feasible && feasible) continue;
    const bool first = outcome == Outcome::feasible && !feasible;
    const double value = outcome == Outcome::feasible ? costOf(x_) : errors_.sum();
    if (!first && value >= least) continue;
    least = value;
    kept = x_;
    feasible = outcome == Outcome::feasible;
    if (feasible && !options.best) break;
  }
  if (!feasible || options.best) {
    x_ = kept;
    measure();
    if (!feasible && outcome != Outcome::cancelled) feasible = polish(stop);
  }
  result.q = q_;
  result.position_error = errors_.position;
  result.rotation_error = errors_.rotation;
  result.penetration = errors_.penetration;
  result.evals = evals_;
  result.status = feasible                        ? IkStatus::solved
                  : outcome == Outcome::cancelled ? IkStatus::cancelled
                  : targetsMet()                  ? IkStatus::colliding
                                                  : IkStatus::unreached;
  if (!feasible) result.message = explain(result.attempts, outcome == Outcome::cancelled);
  return result;
}

/// From a feasible x_ to the nearest one in its neighborhood.
IkSearch::Outcome IkSearch::bringNear(const Stop& stop) {
  if (problem_->pairs.empty()) near_.clear();
  kept_ = x_;
  double least = costOf(x_), share = 1.;
  const auto keepIfBetter = [&] {
    if (!feasible() || costOf(x_) >= least) return;
    least = costOf(x_);
    kept_ = x_;
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
    if (stop()) outcome = Outcome::cancelled;
  }
  if (outcome != Outcome::cancelled && !feasible() && moveApart(10, stop) == Outcome::feasible) keepIfBetter();
  x_ = kept_;
  measure();
  return Outcome::feasible;
}

/// Sum of squares of what misses at the present x.
double IkSearch::squaredMiss() const {
  double sum = square_;
  for (const NearPair& near : near_) {
    const double overlap = std::max(problem_->options.margin - near.distance, 0.);
    sum += overlap * overlap;
  }
  return sum;
}

/// Lessens what the best failure misses by, as far as it goes; true if that made it an answer. Where much is missed, only
/// steps that are damped enough go down (Levenberg).
bool IkSearch::polish(const Stop& stop) {
  kept_ = x_;
  double least = squaredMiss(), damping = 0.;
  for (int i = 0; i < 200 && !stop(); ++i) {
    stepApart(nullptr, damping);
    const double moved = step_.step().lpNorm<Eigen::Infinity>();
    measure();
    if (feasible()) return true;
    if (squaredMiss() < least) {
      least = squaredMiss();
      kept_ = x_;
      damping *= .3;
    } else {
      x_ = kept_;
      measure();
      damping = std::max(4. * damping, 1e-3);
    }
    if (moved < 1e-8) break;
  }
  x_ = kept_;
  measure();
  return false;
}

std::vector<std::string> IkSearch::misses() const {
  const IkOptions& options = problem_->options;
  std::vector<std::string> reasons;
  for (std::size_t i = 0; i < goals_.size(); ++i) {
    const double position = goals_[i].position_error, rotation = goals_[i].rotation_error;
    std::vector<std::string> amounts;
    if (problem_->tasks[i].placed() && position > options.position_tolerance) amounts.push_back(cat(position, " m"));
    if (rotation > options.rotation_tolerance) amounts.push_back(cat(rotation, " rad"));
    if (amounts.empty()) continue;
    reasons.push_back(cat("frame '", problem_->names[i], "' misses its ", kindName(problem_->tasks[i].kind), " by ", join(amounts, " and ")));
  }
  return reasons;
}

/// The worst pairs.
std::vector<std::string> IkSearch::pairsInTheWay() const {
  const double margin = problem_->options.margin;
  std::vector<NearPair> worst;
  std::ranges::copy_if(near_, std::back_inserter(worst), [&](const NearPair& near) { return near.distance < margin + kTouching; });
  std::ranges::sort(worst, {}, &NearPair::distance);
  std::vector<std::string> reasons;
  for (std::size_t i = 0; i < std::min(worst.size(), kPairsNamed); ++i) {
    const double distance = worst[i].distance;
    const std::string how = distance < 0. ? cat("overlap by ", -distance, " m") : cat("are ", distance, " m apart");
    const std::string needed = margin == 0. ? "" : cat(" (the margin is ", margin, " m)");
    reasons.push_back(cat("frames ", pairName(worst[i].pair), " ", how, needed));
  }
  if (worst.size() > kPairsNamed) reasons.push_back(cat("and ", worst.size() - kPairsNamed, " more pairs"));
  return reasons;
}

/// Joints at limits that the targets and the near pairs push them against.
std::vector<std::string> IkSearch::bindingLimits() {
  const Program& program = *problem_->program;
  const int variables = problem_->variables();
  step_.resize(problem_->rows, variables);
  std::fill_n(step_.column(0), problem_->rows * variables, 0.);
  measureTargets(true);
  const double least = kLeastPush * std::sqrt(squaredMiss());
  std::vector<std::string> reasons;
  for (int v = 0; v < variables; ++v) {
    double push = 0.;
    for (int r = 0; r < problem_->rows; ++r) push += step_.column(v)[r] * step_.error(r);
    for (std::size_t n = 0; n < near_.size(); ++n) {
      if (near_[n].distance < problem_->options.margin) {
        push += gradients_[n * variables + v] * (problem_->options.margin - near_[n].distance);
      }
    }
    const bool low = x_[v] <= problem_->lower[v] && push < -least, high = x_[v] >= problem_->upper[v] && push > least;
    if (!low && !high) continue;
    const auto owner = std::ranges::find_if(program.frame_dofs, [&](const Program::DofRange& range) {
      return problem_->dofs[v] >= range.first && problem_->dofs[v] < range.first + range.count;
    });
    const std::string& name = program.frame_name[owner - program.frame_dofs.begin()];
    reasons.push_back(cat("joint '", name, "' is at its ", low ? "lower" : "upper", " limit ", x_[v]));
  }
  return reasons;
}

std::string IkSearch::pairName(int pair) const {
  const auto [a, b] = problem_->pairs[pair];
  return cat("'", problem_->program->frame_name[a], "' and '", problem_->program->frame_name[b], "'");
}

std::string IkSearch::explain(int attempts, bool cancelled) {
  std::string text = cat(cancelled ? "cancelled after " : "no solution in ", attempts, attempts == 1 ? " attempt" : " attempts");
  const auto most = std::ranges::max_element(blocked_);
  if (most != blocked_.end() && *most > 0) {
    int reached = 0;
    for (int count : blocked_) reached += count;
    text += cat("; ", reached, " reached the targets in collision, most often of ", pairName(int(most - blocked_.begin())));
  }
  if (attempts == 0) return text;
  std::vector<std::string> reasons = misses();
  for (const std::string& reason : pairsInTheWay()) reasons.push_back(reason);
  for (const std::string& reason : bindingLimits()) reasons.push_back(reason);
  return cat(text, "; at the nearest, ", join(reasons, "; "));
}

}  // namespace kinegraph
