#include "kinegraph/solvers/methods/augmented_lagrangian_method.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "kinegraph/base/text.h"
#include "kinegraph/solvers/methods/quadratic_step.h"

namespace kinegraph {

namespace {

constexpr double kEnough = .02;  ///< part of the violation that a step may leave, to first order

}  // namespace

/// Goes to the solution of the linearized problem, if that is the solution of the problem.
bool AugmentedLagrangian::solvedInOneStep() {
  if (options_.stopEvals < 2 || !nlp_.mayBeQuadratic()) return false;
  std::optional<QuadraticStep> step = quadraticStep(function_, here_.x, here_.phi, here_.J);
  if (!step && constraints_.empty()) {
    linearize();
    if (learns_curvature_) return false;
    low_ = lower_ - here_.x;
    high_ = upper_ - here_.x;
    step = {here_.x + model_.minimize({here_.c, lambda_, 1., 0., low_, high_, 12}), {}};
  }
  if (!step) return false;
  trial_.x = step->x;
  if (!evaluate(trial_) || !trial_.finite || !isSolution(function_, trial_.x, trial_.phi, trial_.J, step->multipliers))
    return false;
  std::swap(here_, trial_);
  lambda_ = step->multipliers;
  stop(SolverStatus::converged, "the problem is quadratic; one step solves it");
  return true;
}

void AugmentedLagrangian::iterate() {
  const double first_nu = weight_ * options_.damping;
  double nu = is_warm_ && memory_.damping > 0. ? std::min(memory_.damping, first_nu) : first_nu;
  memory_.damping = 0.;
  double growth = 2., last_relative = 1.;
  bool damped_step_retried = false, model_is_stale = true;
  int given_up = 0;
  const double tolerance = options_.stopTolerance;
  const int passes = nlp_.dimension() > 100 ? 3 : 12;
  for (int step = 0; !stopped_; ++step) {
    if (function_.evals() >= options_.stopEvals)
      return stop(SolverStatus::limit, cat("limit of ", options_.stopEvals, " evaluations"));
    if (step >= 20 * options_.stopInners)
      return stop(SolverStatus::limit, cat("limit of ", options_.stopInners, " steps"));
    if (rounds_ >= options_.stopOuters)
      return stop(SolverStatus::limit, cat("limit of ", options_.stopOuters, " rounds"));
    if (model_is_stale) linearize();
    const double h = model_.largestCurvature(), vc = optimalityError(), violation = here_.violation;
    box();
    const LocalModel::Problem problem{here_.c, lambda_, mu_, nu, low_, high_, passes};
    if (model_is_stale && step > 0 && vc <= tolerance_ && nu <= .1 * h && trouble_.empty() &&
        model_.estimateStep(problem) <= tolerance) {
      return converge(nu);
    }
    if (model_is_stale) addCurvature();
    model_is_stale = false;
    const VectorXd& d = model_.minimize(problem);
    const double size = d.lpNorm<Eigen::Infinity>();
    double predicted = model_.decrease(problem);
    const double scale = std::max(std::abs(here_.cost), 1e-4);
    const bool tiny = size <= tolerance || predicted <= std::max(tolerance * tolerance, 1e-16) * scale;
    if (options_.verbose > 2) {
      std::printf("    step %3d  evals %3d  |d| %.3g  predicted %.3g  violation %.3g  mu %.3g  nu %.3g\n", step,
                  function_.evals(), size, predicted, vc, mu_, nu);
    }
    if (creeps(vc))
      return stop(SolverStatus::stalled, cat("the costs hardly fall any more, as along a kink", trouble_));
    if (tiny && nu > .1 * h && nu < 1e8 && (!damped_step_retried || trouble_.empty())) {
      nu = std::max(.1 * h, .01 * nu);  // it may be small because of the damping, not because of the problem
      growth = 2.;
      damped_step_retried = true;
      trouble_.clear();
      continue;
    }
    if (tiny && vc <= tolerance_) {
      if (nu > .1 * h && !trouble_.empty() &&
          predicted > .1 * size * std::max(scale, .01)) {  // larger steps were refused
        return stop(SolverStatus::stalled, cat("no step decreases the objective as predicted", trouble_));
      }
      return converge(nu);
    }
    const bool solved =
        (size <= omega_ && nu <= .1 * h) || last_relative <= rel_ || tiny || nu > 1e10 || predicted <= 0.;
    const bool helps = vc <= tolerance_ || (violation > tolerance_ && linearizedViolation() < .5 * violation);
    if (solved && !(round_just_ended_ && helps && predicted > 0. && nu <= 1e10)) {
      if (nu > 1e10) {
        nu = first_nu;
        if (++given_up == 3)
          return stop(SolverStatus::stalled, cat("no step decreases the objective as predicted", trouble_));
      }
      endRound(vc, size);
      last_relative = 1.;
      if (stopped_ || nu > 1e10 || !helps || linearizedViolation() > kEnough * violation || mu_ != problem.mu) continue;
      predicted = model_.decrease(problem);
      if (!(predicted > 0.)) continue;
    }
    trial_.x = (here_.x + d).cwiseMax(lower_).cwiseMin(upper_);
    const double before = lagrangian(here_);
    if (!evaluate(trial_)) return;
    double after = lagrangian(trial_);
    const double noise = std::max(1e-12, 1e-10 * std::abs(before));
    correction_.helped = false;
    if (trial_.finite && before - after < .5 * predicted && predicted > noise &&
        function_.evals() < options_.stopEvals) {
      if (!correctTrial(after, size, nu, passes)) return;
    }
    double ratio = (before - after) / predicted;
    if (std::abs(before - after) < noise && predicted < noise) {  // only gradients tell which point is better
      ratio = gradientNorm(trial_) < gradientNorm(here_) ? .3 : -1.;
    }
    if (ratio > options_.wolfe) {
      std::swap(here_, trial_);
      const bool was_refused = growth > 2.;  // a step with less damping, from this point
      const double excess = 2. * std::min(ratio, 1.2) - 1.;
      nu = std::max(1e-6, nu * std::max(was_refused || correction_.helped ? .5 : .1, 1. - excess * excess * excess));
      growth = 2.;
      if (ratio > .7 && nu <= .1 * h && optimalityError() <= .25 * vc)
        updateMultipliers(size);  // close: no need to solve it first
      last_relative = (before - after) / std::max(std::abs(before), .01);
      learnCurvature(trial_);
      adaptRadius(size, ratio > .75, false);
      damped_step_retried = round_just_ended_ = false;
      trouble_.clear();
      model_is_stale = true;
      function_.remember(here_);
    } else {
      ++slow_.refused;
      adaptRadius(size, false, true);
      trouble_ = trial_.finite ? ", as at a kink"
                               : cat(": where it would go, ", describeNotFinite(nlp_, trial_.phi, &trial_.J));
      nu = std::max({nu * growth, .0001 * h, 1e-3});
      growth *= 2.;
    }
  }
}

/// Where constraints are curved, a long step along their linearization leaves them. Solves the model again with the
/// constraints as they are at the trial point, and takes the corrected point as the trial if it is better. `value` is
/// the Lagrangian at the trial point. False if the caller stops it. Source: Nocedal & Wright, ch. 18.3 (second-order
/// correction).
bool AugmentedLagrangian::correctTrial(double& value, double size, double shift, int passes) {
  if (correction_.wait > 0) {
    --correction_.wait;
    return true;
  }
  corrected_.x = trial_.x - here_.x;
  corrected_.c = trial_.c;
  for (std::size_t j = 0; j < constraints_.size(); ++j)
    corrected_.c[Eigen::Index(j)] -= here_.J.rowTimes(constraints_[j], corrected_.x);
  const VectorXd& d = model_.minimize({corrected_.c, lambda_, mu_, shift, low_, high_, passes});
  corrected_.x = (here_.x + d).cwiseMax(lower_).cwiseMin(upper_);
  bool better = (corrected_.x - trial_.x).lpNorm<Eigen::Infinity>() <= .5 * size;
  if (better) {
    if (!evaluate(corrected_)) return false;
    const double corrected = lagrangian(corrected_);
    better = corrected < value;
    if (better) {
      value = corrected;
      std::swap(trial_, corrected_);
    }
  }
  correction_.helped = better;
  correction_.failures = better ? 0 : correction_.failures + 1;
  if (correction_.failures >= 2) correction_.wait = std::min(2 << correction_.failures, 32);
  return true;
}

/// True if the constraints hold, steps are refused again and again, and those that are not hardly decrease the costs:
/// less than one in 1 / tolerance an evaluation.
bool AugmentedLagrangian::creeps(double vc) {
  constexpr int kWindow = 10, kRefused = 3;
  const int evals = function_.evals();
  const double now = here_.cost;
  if (constraints_.empty() || (vc <= tolerance_ && evals < slow_.first + kWindow)) return false;
  const double least =
      kWindow * std::min(options_.stopTolerance, options_.stopFTolerance) * std::max(std::abs(now), 1e-4);
  const bool slow = vc <= tolerance_ && slow_.refused >= kRefused && slow_.cost - now < least;
  slow_ = {evals, 0, now};
  return slow;
}

/// An inner problem is solved well enough: new multipliers, and a larger penalty if the violation has not fallen.
void AugmentedLagrangian::endRound(double vc, double step_size) {
  ++rounds_;
  round_just_ended_ = true;
  if (options_.verbose > 1)
    std::printf("  round %d  evals %d  cost %.6g  violation %.3g  mu %.3g\n", rounds_, function_.evals(), here_.cost,
                vc, mu_);
  if (vc > tolerance_) {
    bad_rounds_ = vc > .7 * last_violation_ && mu_ >= 1e3 * weight_ * options_.muInit ? bad_rounds_ + 1 : 0;
    if (bad_rounds_ >= 2) {
      if (locallyInfeasible() && !restored()) {
        return stop(SolverStatus::infeasible, cat("the constraints contradict each other here; least violation found ",
                                                  function_.best().violation));
      }
      bad_rounds_ = 0;
      const bool falls = vc < .5 * violation_at_tests_, is_first = cost_at_tests_ == kInfinity;
      if (falls || is_first || here_.cost < cost_at_tests_ - 1e-4 * std::abs(cost_at_tests_)) {  // slow, but it goes on
        if (falls) violation_at_tests_ = vc;
        cost_at_tests_ = here_.cost;
        failed_tests_ = 0;
      }
      if (++failed_tests_ == 6) return stop(SolverStatus::stalled, cat("the violation no longer falls; it is ", vc));
    }
  }
  updateMultipliers(step_size);
  if (vc > .25 * last_violation_ && vc > tolerance_) mu_ = std::min(weight_ * options_.muMax, options_.muInc * mu_);
  last_violation_ = std::min(last_violation_, vc);
  omega_ = std::max(.3 * omega_, options_.stopTolerance);
  if (vc <= tolerance_) rel_ = std::max(.5 * rel_, 1e-6);
}

/// To those of the model, unless the box kept its step short.
void AugmentedLagrangian::updateMultipliers(double step_size) {
  if (step_size > .5 * radius_) return;
  findMultipliers(model_.linearized(), next_lambda_);
  lambda_.swap(next_lambda_);
  if (options_.lambdaMax > 0.) lambda_ = lambda_.cwiseMin(options_.lambdaMax).cwiseMax(-options_.lambdaMax);
}

}  // namespace kinegraph
