#include <algorithm>
#include <cmath>

#include "kinegraph/solvers/methods/augmented_lagrangian_method.h"

// The restoration phase, for constraints that may contradict each other.

namespace kinegraph::inline solvers_internal {

namespace {

constexpr double kRegularization = 1e-6;  ///< of the squared violation, in units of the largest squared entry of J
constexpr double kCannotFall = .9;  ///< remaining share of the linearized violation that proves local infeasibility
constexpr double kMuchLess = .5;    ///< remaining share of the violation after a successful restoration
constexpr double kNegligible = .1;  ///< share of the tolerance that counts as no violation

constexpr int kMaxSteps = 30;           ///< of the minimization of the violation
constexpr double kFirstDamping = 1e-4;  ///< its Levenberg damping,
constexpr double kDampingGrowth = 10.;  ///< factor after a refused step,
constexpr double kDampingFall = .1;     ///< and after an accepted one
constexpr double kGoodRatio = .5;       ///< actual by expected decrease of a good step
constexpr double kHardlyFalls = 1e-4;   ///< relative decrease of the squared violation that does not justify a step

}  // namespace

/// Whether no step reduces the linearized violation by a tenth.
bool AugmentedLagrangian::locallyInfeasible() {
  next_lambda_.setZero();
  double largest_row = kRegularization;
  for (double value : here_.J.values) largest_row = std::max(largest_row, value * value);
  model_.setNoCosts(kRegularization * largest_row);
  makeBox();
  model_.minimize({here_.c, next_lambda_, 1., 0., low_, high_, kPasses});
  const double before = squaredViolation(here_.c), after = squaredViolation(model_.linearized());
  linearize();
  return std::sqrt(after) >= kCannotFall * std::sqrt(before);
}

/// Moves to a point of least violation, from here or else from the start. True if the violation is much smaller there,
/// so that the solve continues with a larger penalty.
bool AugmentedLagrangian::restored() {
  const double before = here_.violation, enough = std::max(kMuchLess * before, kNegligible * tolerance_);
  reduceViolation();
  if (!stopped_ && ++restorations_ == 1 && here_.violation > enough) {
    const EvaluatedPoint found = here_;
    here_.x = start_;
    if (!evaluate(here_)) return false;
    reduceViolation();
    if (!stopped_ && here_.violation > enough && found.violation <= here_.violation) here_ = found;
  }
  function_.forceBest(here_);
  if (stopped_ || restorations_ > kMaxRestorations || function_.best().violation > enough) return false;
  lambda_.setZero();
  penalty_.restart(restorations_);
  violation_.restart();
  linearize();
  return true;
}

/// Minimizes the violation by Gauss-Newton steps, without the costs.
void AugmentedLagrangian::reduceViolation() {
  next_lambda_.setZero();
  double damping = kFirstDamping;
  for (int step = 0; step < kMaxSteps && function_.evals() < options_.stopEvals; ++step) {
    model_.setJacobian(here_.J);
    model_.setNoCosts(0.);
    makeBox();
    trial_.x = (here_.x + model_.minimize({here_.c, next_lambda_, 1., damping, low_, high_, kPasses}))
                   .cwiseMax(lower_)
                   .cwiseMin(upper_);
    if (!evaluate(trial_)) return;

    // The radius adapts to the steps as in the main iteration.
    const double before = squaredViolation(here_.c), after = squaredViolation(trial_.c),
                 expected = squaredViolation(model_.linearized());
    const bool at_edge = radius_.isAtEdge(model_.step().lpNorm<Eigen::Infinity>()),
               good = before - after > kGoodRatio * (before - expected);
    if (at_edge && good) radius_.growRestoring();
    if (!good) radius_.shrink();

    // Minimum: even the linearized violation would hardly decrease, and nothing limits the step.
    if (before - expected < kHardlyFalls * before && !at_edge && damping <= kFirstDamping * (1. + before)) return;
    if (!(after < before) || !trial_.finite) {
      damping *= kDampingGrowth;
      continue;
    }
    std::swap(here_, trial_);
    damping *= kDampingFall;
    if (std::sqrt(after) < kNegligible * tolerance_) return;
  }
}

}  // namespace kinegraph::inline solvers_internal
