#include "kinegraph/ik/ik_search.h"

#include <algorithm>

#include "kinegraph/common/text.h"
#include "kinegraph/ik/ik_diagnosis.h"
#include "kinegraph/ik/target_questions.h"

namespace kinegraph::inline ik_internal {

IkSearch::IkSearch(std::shared_ptr<const IkProblem> problem)
    : problem_(std::move(problem)), iterate_(*problem_), step_(problem_->variables()) {}

IkResult IkSearch::solve(const std::vector<IkTarget>& targets, const CancellationToken& cancellation,
                         const VectorXd* start) {
  IkJob job;
  open(job, targets, start);
  VectorXd x(problem_->variables());
  for (bool decided = false; !decided;) {
    if (cancellation()) return finish(job, true, cancellation);
    job_ = &job;
    iterate_.select(job);
    iterate_.setStartingPoint(job.attempts, job.start);
    IkApproach made = approach();
    made.evals = 0;  // the iterate has counted them
    x = iterate_.x();
    decided = assess(job, x, made, cancellation);
  }
  return finish(job, false, cancellation);
}

void IkSearch::open(IkJob& job, const std::vector<IkTarget>& targets, const VectorXd* start) {
  job.attempts = job.evals = 0;
  job.feasible = job.cancelled = job.best_is_current = false;
  job.best_value = std::numeric_limits<double>::infinity();
  job.blocked.assign(problem_->pairs.size(), 0);
  job.start = start ? problem_->variablesOf(*start) : VectorXd();
  job.preferred = start ? problem_->preferredFor(job.start) : problem_->preferred;
  job.best.resize(problem_->variables());
  problem_->startingPoint(0, job.best.data(), job.start);
  iterate_.setTargets(job, targets);
}

bool IkSearch::assess(IkJob& job, const VectorXd& x, const IkApproach& made, const CancellationToken& cancellation) {
  job_ = &job;
  iterate_.select(job);
  job.evals += made.evals;
  job.best_is_current = false;
  const int attempts = problem_->options.attempts;
  ++job.attempts;
  iterate_.setX(x);
  double error = made.error;
  Outcome outcome = Outcome::missed;
  // The approach may come from lanes, whose angles are accurate to 2e-8 only. It is evaluated again here, and continued
  // if it does not meet the targets exactly.
  if (made.met) {
    iterate_.evaluateTargets(false);
    if (iterate_.targetsMet() || approach().met) outcome = avoidCollisions(cancellation);
    if (outcome == Outcome::feasible && problem_->has_preference) outcome = approachPreferred(cancellation);
    error = iterate_.errors().sum();
  }
  job.cancelled = outcome == Outcome::cancelled;
  const bool done = job.cancelled || job.attempts == attempts;
  if (outcome != Outcome::feasible && job.feasible) return done;
  // Answers are compared by their cost, failures by their error; any answer is better than a failure.
  const bool first = outcome == Outcome::feasible && !job.feasible;
  const double value = outcome == Outcome::feasible ? costOf(iterate_.x()) : error;
  if (!first && value >= job.best_value) return done;
  job.best_value = value;
  job.best = iterate_.x();
  job.feasible = outcome == Outcome::feasible;
  job.best_is_current = job.feasible;
  return done || (job.feasible && !problem_->options.best);
}

IkResult IkSearch::finish(IkJob& job, bool cancelled, const CancellationToken& cancellation) {
  job_ = &job;
  iterate_.select(job);
  job.cancelled = job.cancelled || cancelled;
  if (cancelled || !job.best_is_current) {
    iterate_.setX(job.best);
    iterate_.evaluate();
  }
  // A failure is described at the point of least error, because the reasons that are reported hold there.
  if (!job.feasible && !job.cancelled) job.feasible = polish(cancellation);
  const IkIterate::Errors& errors = iterate_.errors();
  IkResult result;
  result.q = iterate_.q();
  result.position_error = errors.position;
  result.rotation_error = errors.rotation;
  result.feature_error = errors.feature;
  result.penetration = errors.penetration;
  result.attempts = job.attempts;
  result.evals = job.evals;
  result.status = job.feasible            ? IkStatus::solved
                  : job.cancelled         ? IkStatus::cancelled
                  : iterate_.targetsMet() ? IkStatus::in_collision
                                          : IkStatus::goal_unreachable;
  if (!job.feasible) result.message = describeFailure(*problem_, job, iterate_);
  if (result.status == IkStatus::goal_unreachable) result.message += askAboutQuaternions(job, cancellation);
  if (!problem_->slight.empty()) result.warnings.push_back(problem_->slight);
  if (!problem_->question.empty()) result.warnings.push_back(problem_->question);
  if (problem_->blocking.empty() || result.status == IkStatus::cancelled) return result;
  if (job.feasible) result.status = IkStatus::in_collision;
  result.message = cat(result.message, result.message.empty() ? "" : "; ", problem_->blocking);
  return result;
}

bool IkSearch::stalls(int step, double square, double& before) {
  // Far from a solution Gauss-Newton may wander, so single steps say little. Five steps must halve the sum of squares;
  // otherwise another starting point is the better use of the time.
  if (step % 5 != 4) return false;
  if (square > .5 * before) return true;
  before = square;
  return false;
}

/// Steps from x towards the targets.
IkApproach IkSearch::approach() {
  const int steps = problem_->options.steps, evals = job_->evals;
  double before = 1e300;
  for (int i = 0;; ++i) {
    iterate_.evaluateTargets(true);
    if (iterate_.targetsMet() || i == steps || stalls(i, iterate_.squaredTargets(), before)) break;
    iterate_.stepTowardsTargets();
  }
  const IkIterate::Errors& errors = iterate_.errors();
  return {iterate_.targetsMet(), errors.position + errors.rotation + errors.feature, job_->evals - evals};
}

/// Moves from an evaluated x that meets the targets to one without collisions.
IkSearch::Outcome IkSearch::avoidCollisions(const CancellationToken& cancellation) {
  iterate_.assumeNoPenetration();
  if (problem_->pairs.empty()) return Outcome::feasible;
  iterate_.evaluateDistances();
  if (iterate_.errors().penetration == 0.) return Outcome::feasible;
  // The worst pair of each attempt is counted, so that a failure can name the pair that collided most often.
  ++job_->blocked[std::ranges::min_element(iterate_.nearPairs(), {}, &IkIterate::NearPair::distance)->pair];
  return moveApart(problem_->options.steps, cancellation);
}

/// Steps from an evaluated x, with the distances as constraints, until the iterate is feasible.
IkSearch::Outcome IkSearch::moveApart(int steps, const CancellationToken& cancellation) {
  double before = 1e300;
  for (int i = 0;; ++i) {
    if (iterate_.feasible()) return Outcome::feasible;
    if (i == steps) return Outcome::missed;
    if (i % 8 == 7) {  // more patient than approach: the set of near pairs changes as they move apart
      if (iterate_.errors().sum() > .8 * before) return Outcome::missed;
      before = iterate_.errors().sum();
    }
    if (cancellation()) return Outcome::cancelled;
    iterate_.stepApart(nullptr);
    iterate_.evaluate();
  }
}

/// Moves from a feasible x to the point in its neighborhood that is nearest to the preferred one.
IkSearch::Outcome IkSearch::approachPreferred(const CancellationToken& cancellation) {
  if (problem_->pairs.empty()) iterate_.forgetNearPairs();
  const VectorXd& x = iterate_.x();
  best_ = x;
  double least = costOf(x), share = 1.;
  const auto recordIfBetter = [&] {
    if (!iterate_.feasible() || costOf(x) >= least) return;
    least = costOf(x);
    best_ = x;
  };
  Outcome outcome = Outcome::feasible;
  for (int i = 0; i < 30 && outcome != Outcome::cancelled; ++i) {
    const double before = costOf(x);
    // The step goes all the way to `preferred` in the directions that the targets leave free. If it overshoots, as it
    // does with curved constraints, a smaller share converges.
    step_ = share * (job_->preferred - x);
    iterate_.stepApart(step_.data());
    const double moved = iterate_.lastStep();
    iterate_.evaluate();
    recordIfBetter();
    if (moved < 1e-5) break;
    if (costOf(x) > before) share = std::max(.5 * share, .05);
    if (cancellation()) outcome = Outcome::cancelled;
  }
  // The last step may have left the targets or collided; the next answer from there may still be the nearest.
  if (outcome != Outcome::cancelled && !iterate_.feasible() && moveApart(10, cancellation) == Outcome::feasible)
    recordIfBetter();
  iterate_.setX(best_);
  iterate_.evaluate();
  return Outcome::feasible;
}

/// Reduces the error of the best failure as far as possible; true if that turned it into an answer. If the error is
/// large, only sufficiently damped steps reduce it (Levenberg).
bool IkSearch::polish(const CancellationToken& cancellation) {
  best_ = iterate_.x();
  double least = iterate_.squaredError(), damping = 0.;
  for (int i = 0; i < 200 && !cancellation(); ++i) {
    iterate_.stepApart(nullptr, damping);
    const double moved = iterate_.lastStep();
    iterate_.evaluate();
    if (iterate_.feasible()) return true;
    if (iterate_.squaredError() < least) {
      least = iterate_.squaredError();
      best_ = iterate_.x();
      damping *= .3;
    } else {
      iterate_.setX(best_);
      iterate_.evaluate();
      damping = std::max(4. * damping, 1e-3);
    }
    if (moved < 1e-8) break;
  }
  iterate_.setX(best_);
  iterate_.evaluate();
  return false;
}

/// Asks whether missed rotations are in the order x y z w: so read, they are reached within a few attempts, at most as
/// many as were made before.
std::string IkSearch::askAboutQuaternions(const IkJob& job, const CancellationToken& cancellation) {
  const int most_attempts = std::min(3, job.attempts);
  constexpr double kOther = .1;                                                          // rad
  if (std::ranges::any_of(job.blocked, [](int count) { return count > 0; })) return "";  // they are reached
  IkJob read_otherwise = job;
  bool changes = false;
  for (std::size_t i = 0; i < job.goals.size(); ++i) {
    if (!problem_->tasks[i].hasRotation()) continue;
    IkGoal& goal = read_otherwise.goals[i];
    const Quaterniond given(goal.relative.R), other = readAsXyzw(given);
    changes |= given.angularDistance(other) > kOther;
    goal.relative.R = goal.R = other.toRotationMatrix();
  }
  if (!changes) return "";
  job_ = &read_otherwise;
  iterate_.select(read_otherwise);
  bool met = false;
  for (int i = 0; i < most_attempts && !met && !cancellation(); ++i) {
    iterate_.setStartingPoint(i, read_otherwise.start);
    met = approach().met;
  }
  return met ? "; did you mean w x y z? Read as x y z w, the quaternion is reached" : "";
}

}  // namespace kinegraph::inline ik_internal
