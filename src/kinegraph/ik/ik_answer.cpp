#include <algorithm>
#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/ik/ik_search.h"

namespace kinegraph {

namespace {

constexpr double kTouching = 1e-3;   // m beyond the margin: pairs that are named as in the way
constexpr double kLeastPush = 1e-3;  // m, rad: what a limit that is named would gain per unit of what is missed
constexpr std::size_t kPairsNamed = 3;

}  // namespace

IkResult IkSearch::solve(const std::vector<IkTarget>& targets, const CancellationToken& cancellation) {
  IkJob job;
  open(job, targets);
  VectorXd x(problem_->variables());
  for (bool decided = false; !decided;) {
    if (cancellation()) return finish(job, true, cancellation);
    job_ = &job;
    problem_->startingPoint(job.attempts, x_.data());
    IkApproach made = approach();
    made.evals = 0;  // they are counted
    x = x_;
    decided = judge(job, x, made, cancellation);
  }
  return finish(job, false, cancellation);
}

bool IkSearch::judge(IkJob& job, const VectorXd& x, const IkApproach& made, const CancellationToken& cancellation) {
  job_ = &job;
  job.evals += made.evals;
  job.kept_is_present = false;
  const int attempts = problem_->options.attempts;
  ++job.attempts;
  x_ = x;
  double missed = made.missed;
  Outcome outcome = Outcome::missed;
  // The approach may have been made in lanes, whose angles are good to 2e-8: what counts is what is measured here, and
  // the rest of the way is gone here.
  if (made.met) {
    moveTo(x_);
    step_.resize(problem_->rows, problem_->variables());
    measureTargets(false);
    if (targetsMet() || approach().met) outcome = avoidCollisions(cancellation);
    if (outcome == Outcome::feasible && problem_->pulls) outcome = bringNear(cancellation);
    missed = errors_.sum();
  }
  job.cancelled = outcome == Outcome::cancelled;
  const bool done = job.cancelled || job.attempts == attempts;
  if (outcome != Outcome::feasible && job.feasible) return done;
  // Answers are compared by how near they are, failures by what they miss; any answer is better than a failure.
  const bool first = outcome == Outcome::feasible && !job.feasible;
  const double value = outcome == Outcome::feasible ? costOf(x_) : missed;
  if (!first && value >= job.least) return done;
  job.least = value;
  job.kept = x_;
  job.feasible = outcome == Outcome::feasible;
  job.kept_is_present = job.feasible;
  return done || (job.feasible && !problem_->options.best);
}

IkResult IkSearch::finish(IkJob& job, bool cancelled, const CancellationToken& cancellation) {
  job_ = &job;
  job.cancelled = job.cancelled || cancelled;
  if (cancelled || !job.kept_is_present) {
    x_ = job.kept;
    measure();
  }
  // A failure is told at the point that misses least, since the reasons that are named are those that hold there.
  if (!job.feasible && !job.cancelled) job.feasible = polish(cancellation);
  IkResult result;
  result.q = q_;
  result.position_error = errors_.position;
  result.rotation_error = errors_.rotation;
  result.feature_error = errors_.feature;
  result.penetration = errors_.penetration;
  result.attempts = job.attempts;
  result.evals = job.evals;
  result.status = job.feasible    ? IkStatus::solved
                  : job.cancelled ? IkStatus::cancelled
                  : targetsMet()  ? IkStatus::in_collision
                                  : IkStatus::goal_unreachable;
  if (!job.feasible) result.message = explain();
  if (problem_->in_the_way.empty() || result.status == IkStatus::cancelled) return result;
  if (job.feasible) result.status = IkStatus::in_collision;
  result.message = cat(result.message, result.message.empty() ? "" : "; ", problem_->in_the_way);
  return result;
}

/// From a feasible x_ to the nearest one in its neighborhood.
IkSearch::Outcome IkSearch::bringNear(const CancellationToken& cancellation) {
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
    // The step goes all the way towards `nearest` in what the targets leave free; where that overshoots, as curved
    // constraints make it, a smaller share converges.
    pull_ = share * (problem_->nearest - x_);
    stepApart(pull_.data());
    const double moved = step_.step().lpNorm<Eigen::Infinity>();
    measure();
    keepIfBetter();
    if (moved < 1e-5) break;
    if (costOf(x_) > before) share = std::max(.5 * share, .05);
    if (cancellation()) outcome = Outcome::cancelled;
  }
  // The last step may have left the targets or touched something: the next answer from there may still be the nearest.
  if (outcome != Outcome::cancelled && !feasible() && moveApart(10, cancellation) == Outcome::feasible) keepIfBetter();
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

/// Lessens what the best failure misses by, as far as it goes; true if that made it an answer. Where much is missed,
/// only steps that are damped enough go down (Levenberg).
bool IkSearch::polish(const CancellationToken& cancellation) {
  kept_ = x_;
  double least = squaredMiss(), damping = 0.;
  for (int i = 0; i < 200 && !cancellation(); ++i) {
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
  for (std::size_t i = 0; i < job_->goals.size(); ++i) {
    const IkProblem::Task& task = problem_->tasks[i];
    const IkGoal& goal = job_->goals[i];
    std::vector<std::string> amounts;
    if (goal.position_error > options.position_tolerance) amounts.push_back(cat(goal.position_error, " m"));
    if (goal.rotation_error > options.rotation_tolerance) amounts.push_back(cat(goal.rotation_error, " rad"));
    if (task.residual && goal.feature_error > task.target.feature->tolerance)
      amounts.push_back(cat(goal.feature_error, task.unitOf(goal.worst_row)));
    if (amounts.empty()) continue;
    reasons.push_back(cat(task.name(), " misses its ", task.goal(), " by ", join(amounts, " and ")));
  }
  return reasons;
}

/// The worst pairs.
std::vector<std::string> IkSearch::pairsInTheWay() const {
  const double margin = problem_->options.margin;
  std::vector<NearPair> worst;
  std::ranges::copy_if(near_, std::back_inserter(worst),
                       [&](const NearPair& near) { return near.distance < margin + kTouching; });
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
  const KinematicModel& model = *problem_->model;
  const int variables = problem_->variables();
  step_.resize(problem_->rows, variables);
  std::fill_n(step_.column(0), problem_->rows * variables, 0.);
  measureTargets(true);
  // The negative gradient of what is missed is what pushes; at a point of least miss it is zero but against limits.
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
    reasons.push_back(
        cat("joint '", jointName(model, problem_->dofs[v]), "' is at its ", low ? "lower" : "upper", " limit ", x_[v]));
  }
  return reasons;
}

std::string IkSearch::pairName(int pair) const {
  const auto [a, b] = problem_->pairs[pair];
  return cat("'", problem_->model->frame_name[a], "' and '", problem_->model->frame_name[b], "'");
}

std::string IkSearch::explain() {
  const int attempts = job_->attempts;
  std::string text =
      cat(job_->cancelled ? "cancelled after " : "no solution in ", attempts, attempts == 1 ? " attempt" : " attempts");
  const auto most = std::ranges::max_element(job_->blocked);
  if (most != job_->blocked.end() && *most > 0) {
    int reached = 0;
    for (int count : job_->blocked) reached += count;
    text += cat("; ", reached, " reached the targets in collision, most often of ",
                pairName(int(most - job_->blocked.begin())));
  }
  if (attempts == 0) return text;
  std::vector<std::string> reasons = misses();
  for (const std::string& reason : pairsInTheWay()) reasons.push_back(reason);
  for (const std::string& reason : bindingLimits()) reasons.push_back(reason);
  return cat(text, "; at the nearest, ", join(reasons, "; "));
}

}  // namespace kinegraph
