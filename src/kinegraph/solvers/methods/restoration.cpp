#include <algorithm>
#include <cmath>

#include "kinegraph/solvers/methods/augmented_lagrangian_method.h"

// What the method does where constraints seem to contradict each other.

namespace kinegraph {

/// True if no step reduces the linearized violation by a tenth.
bool AugmentedLagrangian::locallyInfeasible() {
  next_lambda_.setZero();
  double largest_row = 1e-6;
  for (double value : here_.J.values) largest_row = std::max(largest_row, value * value);
  model_.setNoCosts(1e-6 * largest_row);
  box();
  model_.minimize({here_.c, next_lambda_, 1., 0., low_, high_, 12});
  const double before = squaredViolation(here_.c), after = squaredViolation(model_.linearized());
  linearize();
  return std::sqrt(after) >= .9 * std::sqrt(before);
}

/// Goes to a point of least violation, from here or else from the start. True if the violation is much less there, so
/// that it can go on, with a larger penalty.
bool AugmentedLagrangian::restored() {
  const double before = here_.violation, enough = std::max(.5 * before, .1 * tolerance_);
  reduceViolation();
  if (!stopped_ && ++restorations_ == 1 && here_.violation > enough) {
    const EvaluatedPoint found = here_;
    here_.x = start_;
    if (!evaluate(here_)) return false;
    reduceViolation();
    if (!stopped_ && here_.violation > enough && found.violation <= here_.violation) here_ = found;
  }
  function_.forceBest(here_);
  if (stopped_ || restorations_ > 5 || function_.best().violation > enough) return false;
  lambda_.setZero();
  mu_ = std::min(weight_ * options_.muMax, std::pow(10., restorations_) * weight_ * options_.muInit);
  last_violation_ = violation_at_tests_ = cost_at_tests_ = kInfinity;
  linearize();
  return true;
}

/// Gauss-Newton steps on the violation alone, so that the answer is the least one and no compromise with the costs.
void AugmentedLagrangian::reduceViolation() {
  next_lambda_.setZero();
  double damping = 1e-4;
  for (int step = 0; step < 30 && function_.evals() < options_.stopEvals; ++step) {
    model_.setJacobian(here_.J);
    model_.setNoCosts(0.);
    box();
    trial_.x = (here_.x + model_.minimize({here_.c, next_lambda_, 1., damping, low_, high_, 12}))
                   .cwiseMax(lower_)
                   .cwiseMin(upper_);
    if (!evaluate(trial_)) return;
    const double before = squaredViolation(here_.c), after = squaredViolation(trial_.c),
                 expected = squaredViolation(model_.linearized());
    const bool at_edge = model_.step().lpNorm<Eigen::Infinity>() >= .99 * radius_,
               good = before - after > .5 * (before - expected);
    if (at_edge && good) radius_ *= 4.;
    if (!good) radius_ = std::max(options_.stepMax, .25 * radius_);
    if (before - expected < 1e-4 * before && !at_edge && damping <= 1e-4 * (1. + before)) return;
    if (!(after < before) || !trial_.finite) {
      damping *= 10.;
      continue;
    }
    std::swap(here_, trial_);
    damping *= .1;
    if (std::sqrt(after) < .1 * tolerance_) return;
  }
}

}  // namespace kinegraph
