#include "kinegraph/solvers/methods/augmented_lagrangian_method.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "kinegraph/common/log.h"
#include "kinegraph/common/text.h"
#include "kinegraph/solvers/methods/quadratic_step.h"

namespace kinegraph::inline solvers_internal {

AugmentedLagrangian::AugmentedLagrangian(Nlp& nlp, Memory& memory, const VectorXd& x0, const SolverOptions& options)
    : nlp_(nlp),
      options_(options),
      memory_(memory),
      constraints_(function_.constraints()),
      equalities_(function_.equalities()),
      lower_(function_.lower()),
      upper_(function_.upper()),
      tolerance_(options.constraintTolerance()),
      has_many_variables_(nlp.dimension() > kManyVariables),
      passes_(has_many_variables_ ? kPassesOfMany : kPasses),
      penalty_(options, 1.),
      damping_(options.damping, options.damping),
      radius_(options.stepMax),
      inner_(has_many_variables_),
      stagnation_(options),
      remainder_(options) {
  here_.x = start_ = x0.cwiseMax(lower_).cwiseMin(upper_);
  lambda_.setZero();
}

SolverResult AugmentedLagrangian::run(const VectorXd& dual) {
  search(dual);
  return function_.result(status_ == SolverStatus::converged ? here_ : function_.best(), lambda_, status_, message_);
}

void AugmentedLagrangian::search(const VectorXd& dual) {
  if (function_.hasGeneralCosts()) curvature_.reset(nlp_.dimension());
  const bool is_warm = dual.size() == here_.phi.size();
  if (is_warm) {
    for (std::size_t j = 0; j < constraints_.size(); ++j) lambda_[Eigen::Index(j)] = dual[constraints_[j]];
  }
  evaluate(here_);
  function_.requireFiniteStart(here_);
  function_.remember(here_);
  // Penalty and damping are in units of the steepness of the costs; a warm start continues with its last damping.
  const double cost_weight = Penalty::costWeight(steepness()), first_damping = cost_weight * options_.damping;
  penalty_ = Penalty(options_, cost_weight);
  damping_ = Damping(first_damping,
                     is_warm && memory_.damping > 0. ? std::min(memory_.damping, first_damping) : first_damping);
  if (nlp_.dimension() == 0) {
    stop(holds(here_.violation) ? SolverStatus::converged : SolverStatus::infeasible, "the problem has no variables");
  } else if (!solvedInOneStep()) {
    memory_.damping = 0.;
    iterate();
  }
  memory_.penalty = penalty_.value();
}

/// Moves to the solution of the linearized problem, if that solves the problem.
bool AugmentedLagrangian::solvedInOneStep() {
  if (options_.stopEvals < 2 || !nlp_.mayBeQuadratic()) return false;
  std::optional<QuadraticStep> step = quadraticStep(function_, here_.x, here_.phi, here_.J);
  if (!step && constraints_.empty()) {
    linearize();
    if (learns_curvature_) return false;
    low_ = lower_ - here_.x;
    high_ = upper_ - here_.x;
    step = {here_.x + model_.minimize({here_.c, lambda_, 1., 0., low_, high_, kPasses}), {}};
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

/// Minimizes the Lagrangian in outer iterations (rounds). docs/architecture.md describes it in the same order.
void AugmentedLagrangian::iterate() {
  for (int steps = 0; !stopped_ && !reachedLimit(steps); ++steps) {
    // 1. Model. At a new point the factorization of the last model already predicts whether a step would be tiny: most
    //    solves end here, without another factorization.
    const bool is_new_point = model_is_stale_;
    if (is_new_point) linearize();
    Step step = startStep();
    Problem problem = modelProblem();
    if (is_new_point && steps > 0 && needsNoStep(step, problem)) {
      if (activatesConstraints(true)) continue;
      return converge();
    }
    if (is_new_point) addCurvature();
    model_is_stale_ = false;

    // 2. Step: minimizes the model in a box.
    findStep(problem, step);
    if (has_many_variables_ && round_just_ended_) {
      raisePenalty(step);
      problem.mu = penalty_.value();
    }
    if (options_.verbose > 2)
      logMessage(LogLevel::info,
                 cat("    step ", steps, "  evals ", function_.evals(), "  |d| ", step.size, "  predicted ",
                     step.predicted, "  violation ", step.error, "  mu ", problem.mu, "  damping ", problem.damping));

    // 3. Convergence. At non-smooth points costs may stagnate for hundreds of evaluations. A tiny step proves nothing
    // if
    //    damping keeps it short.
    if (!constraints_.empty() && stagnation_.stagnates(function_.evals(), here_.cost, holds(step.error)))
      return stop(SolverStatus::stalled,
                  cat("the relative decrease of the costs per evaluation is below stopFTolerance", refusal_));
    if (step.is_tiny && triesLessDamping(step)) continue;
    if (holds(step.error) && (step.is_tiny || (is_new_point && costsHaveConverged(step)))) {
      endAt(step);
      continue;
    }

    // 4. Outer iteration. If the inner problem is solved, multipliers and penalty are updated. The current step is
    // still
    //    tried if it improves the constraints: it is then often better than the step of the new model.
    if (roundIsOver(step) && !continuesAfterRound(problem, step)) continue;

    // 5. Trial. The ratio of actual and predicted decrease decides on the step, and on the damping of the next one.
    if (!tryStep(step)) return;
    if (step.ratio > options_.wolfe) {
      accept(step);
      if (function_.activatesAtEachStep()) activatesConstraints(false);
    } else {
      refuse(step);
    }
  }
}

bool AugmentedLagrangian::reachedLimit(int steps) {
  const int most_steps = kStepsPerInner * options_.stopInners;
  if (function_.evals() >= options_.stopEvals) {
    char text[64];  // control loops end here at every call, without allocations
    std::snprintf(text, sizeof text, "limit of %d evaluations", options_.stopEvals);
    stop(SolverStatus::limit, text);
  } else if (steps >= most_steps)
    stop(SolverStatus::limit, cat("limit of ", most_steps, " steps, ", kStepsPerInner, " times stopInners"));
  else if (rounds_ >= options_.stopOuters)
    stop(SolverStatus::limit, cat("limit of ", options_.stopOuters, " outer iterations"));
  return stopped_;
}

AugmentedLagrangian::Step AugmentedLagrangian::startStep() {
  return {.curvature = model_.largestCurvature(), .error = constraintError(), .violation = here_.violation};
}

AugmentedLagrangian::Problem AugmentedLagrangian::modelProblem() {
  makeBox();
  return {here_.c, lambda_, penalty_.value(), damping_.value(), low_, high_, passes_};
}

bool AugmentedLagrangian::needsNoStep(const Step& step, const Problem& problem) {
  return holds(step.error) && damping_.isSmall(step.curvature) && refusal_.empty() &&
         model_.estimateStep(problem) <= options_.stopTolerance;
}

void AugmentedLagrangian::findStep(const Problem& problem, Step& step) {
  const double tolerance = options_.stopTolerance, scale = std::max(std::abs(here_.cost), kMinScale);
  step.size = model_.minimize(problem).lpNorm<Eigen::Infinity>();
  step.predicted = model_.decrease(problem);
  step.is_tiny = step.size <= tolerance || step.predicted <= std::max(tolerance * tolerance, kMinDecrease) * scale;
}

/// Whether this undamped step and all later ones hardly decrease the costs. Problems of few variables always continue
/// to a tiny step: their evaluations are cheap.
bool AugmentedLagrangian::costsHaveConverged(const Step& step) const {
  return has_many_variables_ && !constraints_.empty() && !learns_curvature_ && refusal_.empty() &&
         damping_.isSmall(step.curvature) && remainder_.isSmall(step.predicted, here_.cost);
}

/// Raises the penalty at once if even the step of the model leaves much of the violation and the next penalty leaves
/// less. This saves an outer iteration. It does not raise large penalties further; only failed outer iterations do.
/// Source: Curtis, Jiang & Robinson, An adaptive augmented Lagrangian method for large-scale constrained optimization,
/// 2015 (steering).
void AugmentedLagrangian::raisePenalty(Step& step) {
  const double left = linearizedViolation();
  if (step.is_tiny || damping_.isLost() || penalty_.isLarge() || holds(step.violation) ||
      left <= Penalty::kSteering * step.violation)
    return;
  const Penalty before = penalty_;
  penalty_.grow();
  findStep(modelProblem(), step);
  if (linearizedViolation() <= Penalty::kWorthwhile * left) return;
  penalty_ = before;
  findStep(modelProblem(), step);
}

/// Reduces the damping if it may be the reason of a tiny step: as long as steps are accepted, and once after a refusal.
bool AugmentedLagrangian::triesLessDamping(const Step& step) {
  if (damping_.isSmall(step.curvature) || damping_.isHigh() || (tried_less_damping_ && !refusal_.empty())) return false;
  damping_.relax(step.curvature);
  tried_less_damping_ = true;
  refusal_ = {};
  return true;
}

/// Ends the solve at a feasible point with a tiny step. It is a solution, unless the slope is steep and the step is
/// tiny only because longer ones were refused.
void AugmentedLagrangian::endAt(const Step& step) {
  const double scale = std::max(std::abs(here_.cost), kMinScale);
  const bool is_steep = step.predicted > kSteepSlope * step.size * std::max(scale, kMinSlopeScale);
  if (!damping_.isSmall(step.curvature) && !refusal_.empty() && is_steep)
    return stop(SolverStatus::stalled, cat("no step decreases the objective as predicted", refusal_));
  if (!activatesConstraints(true)) converge();
}

/// Activates lazy constraints that this point violates or may violate soon. The multipliers of all others stay. False
/// if there are none.
bool AugmentedLagrangian::activatesConstraints(bool is_solution) {
  if (activations_ == kMaxActivations) return false;
  const Refinement found = function_.activateConstraints(here_, is_solution, activated_);
  if (found == Refinement::much && is_solution) {
    stop(SolverStatus::stalled, "lazy constraints are violated by much");
    return true;
  }
  if (activated_.empty()) return false;
  ++activations_;
  if (options_.verbose > 1)
    logMessage(LogLevel::info, cat("  evals ", function_.evals(), "  ", activated_.size(),
                                   " constraints activated  violation ", here_.violation));
  for (std::size_t j = 0; j < constraints_.size(); ++j)
    if (std::ranges::find(activated_, constraints_[j]) != activated_.end()) lambda_[Eigen::Index(j)] = 0.;
  violation_.restart();
  tried_less_damping_ = false;
  refusal_ = {};
  model_is_stale_ = true;
  return true;
}

/// Whether the constraints hold, or the step reduces their violation to first order.
bool AugmentedLagrangian::improvesConstraints(const Step& step) const {
  return holds(step.error) || (!holds(step.violation) && linearizedViolation() < kImproves * step.violation);
}

/// Whether the inner problem is solved. Directly after an outer iteration, a step that improves the constraints comes
/// first, so that multipliers stay consistent with their point.
bool AugmentedLagrangian::roundIsOver(const Step& step) const {
  const bool is_solved = inner_.isSolved(step.size, !damping_.isSmall(step.curvature)) || step.is_tiny ||
                         damping_.isLost() || step.predicted <= 0.;
  return is_solved && !(round_just_ended_ && step.predicted > 0. && !damping_.isLost() && improvesConstraints(step));
}

/// Ends the outer iteration. True if the step shall still be tried: it nearly fulfills the linearized constraints, the
/// penalty has not changed, and the model predicts a decrease with the new multipliers.
bool AugmentedLagrangian::continuesAfterRound(const Problem& problem, Step& step) {
  const bool helped = improvesConstraints(step);
  if (damping_.isLost()) {
    damping_.restart();
    if (++times_lost_ == kMaxLost) {
      stop(SolverStatus::stalled, cat("no step decreases the objective as predicted", refusal_));
      return false;
    }
  }
  endRound(step);
  inner_.beginRound();
  if (stopped_ || model_is_stale_ || damping_.isLost() || !helped ||
      linearizedViolation() > kNearlyFeasible * step.violation || penalty_.value() != problem.mu)
    return false;
  step.predicted = model_.decrease(problem);
  return step.predicted > 0.;
}

/// Updates the multipliers, and raises the penalty after an insufficient decrease of the violation.
void AugmentedLagrangian::endRound(const Step& step) {
  ++rounds_;
  round_just_ended_ = true;
  if (options_.verbose > 1)
    logMessage(LogLevel::info, cat("  round ", rounds_, "  evals ", function_.evals(), "  cost ", here_.cost,
                                   "  violation ", step.error, "  mu ", penalty_.value()));
  if (!holds(step.error) && meetsContradiction(step)) return;
  updateMultipliers(step.size);
  if (needsLargerPenalty(step)) penalty_.grow();
  violation_.addRound(step.error);
  inner_.tighten(options_.stopTolerance, holds(step.error));
  activatesConstraints(false);
}

/// Whether the violation has not decreased enough because of the penalty. If the step of the model removes it to first
/// order, as on paths with curved constraints, a larger penalty would only shorten the steps; it grows nevertheless if
/// this happens again and again.
bool AugmentedLagrangian::needsLargerPenalty(const Step& step) {
  const bool is_insufficient = !holds(step.error) && !violation_.fellEnough(step.error);
  const bool is_curved = has_many_variables_ && linearizedViolation() < Penalty::kCurved * step.violation;
  const bool is_kept = is_insufficient && is_curved && penalties_kept_ < Penalty::kMostKept;
  penalties_kept_ = is_kept ? penalties_kept_ + 1 : 0;
  return is_insufficient && !is_kept;
}

/// Checks for contradicting constraints if the violation does not fall under a large penalty. True if the solve ends:
/// neither this point nor one of least violation allows progress, or progress failed too often.
bool AugmentedLagrangian::meetsContradiction(const Step& step) {
  if (!violation_.isStuck(step.error, penalty_.isLarge())) return false;
  if (locallyInfeasible() && !restored()) {
    if (stopped_) return true;  // by the callback
    stop(SolverStatus::infeasible, cat("the constraints contradict each other locally; the least violation found is ",
                                       function_.best().violation));
  } else if (violation_.isHopeless(step.error, here_.cost)) {
    stop(SolverStatus::stalled, cat("the violation ", step.error, " no longer falls"));
  }
  return stopped_;
}

/// Sets the multipliers to those of the model, unless the box limited its step.
void AugmentedLagrangian::updateMultipliers(double step_size) {
  if (!radius_.leavesFree(step_size)) return;
  findMultipliers(model_.linearized(), next_lambda_);
  lambda_.swap(next_lambda_);
  if (options_.lambdaMax > 0.) lambda_ = lambda_.cwiseMin(options_.lambdaMax).cwiseMax(-options_.lambdaMax);
}

/// Evaluates the end of the step, or of its correction, and compares it with the prediction. False if the callback
/// cancels the solve.
bool AugmentedLagrangian::tryStep(Step& step) {
  trial_.x = (here_.x + model_.step()).cwiseMax(lower_).cwiseMin(upper_);
  step.before = lagrangian(here_);
  if (!evaluate(trial_)) return false;
  step.after = lagrangian(trial_);
  const double rounding = std::max(kMinRounding, kRounding * std::abs(step.before));
  was_corrected_ = false;
  const bool is_poor = trial_.finite && step.before - step.after < kPoor * step.predicted && step.predicted > rounding;
  if (is_poor && function_.evals() < options_.stopEvals && (!has_many_variables_ || isSpoiltByPenalties()) &&
      correction_.isDue()) {
    if (!correctTrial(step)) return false;
  }
  step.ratio = (step.before - step.after) / step.predicted;
  if (std::abs(step.before - step.after) < rounding &&
      step.predicted < rounding)  // only gradients show which point is better
    step.ratio = gradientNorm(trial_) < gradientNorm(here_) ? kFair : -1.;
  return true;
}

/// Whether the squares of the constraints cause the error of the model, so that a correction can reduce it. The
/// contribution of the multipliers is curvature of the Lagrangian, which needs shorter steps.
bool AugmentedLagrangian::isSpoiltByPenalties() {
  findMultipliers(model_.linearized(), next_lambda_);
  findMultipliers(trial_.c, multipliers_);
  multipliers_ -= next_lambda_;
  return multipliers_.squaredNorm() > 2. * next_lambda_.cwiseProduct(multipliers_).lpNorm<1>();
}

/// Corrects the trial point for curved constraints: solves the model again with their values at the trial point, and
/// accepts the corrected point if it is better. False if the callback cancels the solve. Source: Nocedal & Wright, ch.
/// 18.3 (second-order correction).
bool AugmentedLagrangian::correctTrial(Step& step) {
  corrected_.x = trial_.x - here_.x;
  corrected_.c = trial_.c;
  for (std::size_t j = 0; j < constraints_.size(); ++j)
    corrected_.c[Eigen::Index(j)] -= here_.J.rowTimes(constraints_[j], corrected_.x);
  const VectorXd& d =
      model_.minimize({corrected_.c, lambda_, penalty_.value(), damping_.value(), low_, high_, passes_});
  corrected_.x = (here_.x + d).cwiseMax(lower_).cwiseMin(upper_);
  if ((corrected_.x - trial_.x).lpNorm<Eigen::Infinity>() <= kNearCorrection * step.size) {
    if (!evaluate(corrected_)) return false;
    const double after = lagrangian(corrected_);
    was_corrected_ = after < step.after;
    if (was_corrected_) {
      step.after = after;
      std::swap(trial_, corrected_);
    }
  }
  correction_.addCorrection(was_corrected_);
  return true;
}

/// Returns the curvature of the model along its minimizing step.
double AugmentedLagrangian::curvatureAlong(const Step& step) const {
  return 2. * step.predicted / model_.step().squaredNorm();
}

void AugmentedLagrangian::accept(const Step& step) {
  std::swap(here_, trial_);
  damping_.accept(step.ratio, was_corrected_);
  if (has_many_variables_) damping_.meet(step.ratio, Damping::lacking(step.ratio, curvatureAlong(step)));
  // Close to the solution, with the convergence of Newton's method, the multipliers are updated at once.
  if (step.ratio > kGood && damping_.isSmall(step.curvature) && constraintError() <= kFastFall * step.error)
    updateMultipliers(step.size);
  inner_.addStep(step.before, step.after);
  remainder_.addStep(step.predicted);
  learnCurvature(trial_);
  radius_.accept(step.size, step.ratio > kVeryGood);
  tried_less_damping_ = round_just_ended_ = false;
  refusal_ = {};
  model_is_stale_ = true;
  function_.remember(here_);
}

/// Keeps the model for a shorter step.
void AugmentedLagrangian::refuse(const Step& step) {
  stagnation_.addRefusal();
  radius_.refuse();
  if (trial_.finite) {
    refusal_ = ", possibly at a non-smooth point";
  } else {
    refusal_ = not_finite_ = cat(": at the trial point, ", describeNotFinite(nlp_, trial_.phi, &trial_.J));
  }
  damping_.refuse(step.curvature, has_many_variables_ && trial_.finite
                                      ? Damping::lacking(step.ratio, curvatureAlong(step))
                                      : kInfinity);
}

void AugmentedLagrangian::stop(SolverStatus status, std::string_view message) {
  status_ = status;
  message_ = message;
  stopped_ = true;
}

void AugmentedLagrangian::converge() {
  memory_.damping = damping_.value();
  stop(SolverStatus::converged, "step, predicted decrease and violation are within their tolerances");
}

bool AugmentedLagrangian::evaluate(EvaluatedPoint& point) {
  if (function_.evaluate(point)) return true;
  stop(SolverStatus::cancelled, "cancelled by the caller");
  return false;
}

}  // namespace kinegraph::inline solvers_internal
