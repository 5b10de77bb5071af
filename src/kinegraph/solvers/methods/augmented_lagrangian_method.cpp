#include "kinegraph/solvers/methods/augmented_lagrangian_method.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "kinegraph/common/text.h"
#include "kinegraph/solvers/methods/quadratic_step.h"

namespace kinegraph {

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
      creep_(options) {
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
  // Penalty and damping are in units of how steep the costs are; a warm start goes on with the damping that it had.
  const double cost_weight = Penalty::costWeight(steepness()), first_damping = cost_weight * options_.damping;
  penalty_ = Penalty(options_, cost_weight);
  damping_ = Damping(first_damping,
                     is_warm && memory_.damping > 0. ? std::min(memory_.damping, first_damping) : first_damping);
  if (nlp_.dimension() == 0) {
    stop(holds(here_.violation) ? SolverStatus::converged : SolverStatus::infeasible, "there is nothing to vary");
  } else if (!solvedInOneStep()) {
    memory_.damping = 0.;
    iterate();
  }
  memory_.penalty = penalty_.value();
}

/// Goes to the solution of the linearized problem, if that is the solution of the problem.
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

/// Steps towards the least Lagrangian, in rounds. docs/architecture.md describes it in the same order.
void AugmentedLagrangian::iterate() {
  for (int steps = 0; !stopped_ && !reachedLimit(steps); ++steps) {
    // 1. Model. At a new point the factor of the last model already tells whether a step would be tiny: most solutions
    //    end here, without the cost of another factor.
    const bool is_new_point = model_is_stale_;
    if (is_new_point) linearize();
    Step step = startStep();
    Problem problem = modelProblem();
    if (is_new_point && steps > 0 && needsNoStep(step, problem)) {
      if (takesUpConstraints(true)) continue;
      return converge();
    }
    if (is_new_point) addCurvature();
    model_is_stale_ = false;

    // 2. Step: the least value of the model in a box.
    findStep(problem, step);
    if (has_many_variables_ && round_just_ended_) {
      raisePenalty(step);
      problem.mu = penalty_.value();
    }
    if (options_.verbose > 2)
      std::printf("    step %3d  evals %3d  |d| %.3g  predicted %.3g  violation %.3g  mu %.3g  damping %.3g\n", steps,
                  function_.evals(), step.size, step.predicted, step.error, problem.mu, problem.damping);

    // 3. Convergence. Costs that creep along a kink would do so for hundreds of evaluations; and a tiny step proves
    //    nothing while it may be the damping that keeps it short.
    if (!constraints_.empty() && creep_.creeps(function_.evals(), here_.cost, holds(step.error)))
      return stop(SolverStatus::stalled, cat("the costs hardly fall any more, as along a kink", trouble_));
    if (step.is_tiny && triesLessDamping(step)) continue;
    if (step.is_tiny && holds(step.error)) {
      endAt(step);
      continue;
    }

    // 4. Round. With an inner problem that is solved, multipliers and penalty are updated. The step at hand is tried
    //    all the same if it serves the constraints, as it then often does better than what the new model would say.
    if (roundIsOver(step) && !goesOnAfterRound(problem, step)) continue;

    // 5. Trial. What the model promised and what came of it decide on the step, and on the damping of the next one.
    if (!tryStep(step)) return;
    if (step.ratio > options_.wolfe) {
      accept(step);
      if (function_.takesUpAtEachStep()) takesUpConstraints(false);
    } else {
      refuse(step);
    }
  }
}

bool AugmentedLagrangian::reachedLimit(int steps) {
  const int most_steps = kStepsPerInner * options_.stopInners;
  if (function_.evals() >= options_.stopEvals) {
    char text[64];  // loops end here at every call, and request no memory
    std::snprintf(text, sizeof text, "limit of %d evaluations", options_.stopEvals);
    stop(SolverStatus::limit, text);
  } else if (steps >= most_steps)
    stop(SolverStatus::limit, cat("limit of ", most_steps, " steps, ", kStepsPerInner, " times stopInners"));
  else if (rounds_ >= options_.stopOuters)
    stop(SolverStatus::limit, cat("limit of ", options_.stopOuters, " rounds"));
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
  return holds(step.error) && damping_.isSmall(step.curvature) && trouble_.empty() &&
         model_.estimateStep(problem) <= options_.stopTolerance;
}

void AugmentedLagrangian::findStep(const Problem& problem, Step& step) {
  const double tolerance = options_.stopTolerance, scale = std::max(std::abs(here_.cost), kLeastScale);
  step.size = model_.minimize(problem).lpNorm<Eigen::Infinity>();
  step.predicted = model_.decrease(problem);
  step.is_tiny = step.size <= tolerance || step.predicted <= std::max(tolerance * tolerance, kLeastDecrease) * scale;
}

/// Where even the model's step would leave much of the violation, a round of evaluations under this penalty would only show
/// that it must grow: the next penalty is taken at once, if the model does better with it; not beyond what is much, which
/// only rounds in vain tell to be needed. Source: Curtis, Jiang & Robinson, An adaptive augmented Lagrangian method for
/// large-scale constrained optimization, 2015 (steering).
void AugmentedLagrangian::raisePenalty(Step& step) {
  const double left = linearizedViolation();
  if (step.is_tiny || damping_.isLost() || penalty_.isMuch() || holds(step.violation) ||
      left <= Penalty::kSteering * step.violation)
    return;
  const Penalty before = penalty_;
  penalty_.grow();
  findStep(modelProblem(), step);
  if (linearizedViolation() <= Penalty::kWorthwhile * left) return;
  penalty_ = before;
  findStep(modelProblem(), step);
}

/// A tiny step may be due to the damping. Once after a refusal, and as long as steps are accepted, it is worth a look
/// how long it is with less.
bool AugmentedLagrangian::triesLessDamping(const Step& step) {
  if (damping_.isSmall(step.curvature) || damping_.isHigh() || (tried_less_damping_ && !trouble_.empty())) return false;
  damping_.relax(step.curvature);
  tried_less_damping_ = true;
  trouble_.clear();
  return true;
}

/// The constraints hold and the step is tiny: a solution, unless it is tiny only since longer ones were refused, though
/// the slope is steep.
void AugmentedLagrangian::endAt(const Step& step) {
  const double scale = std::max(std::abs(here_.cost), kLeastScale);
  const bool is_steep = step.predicted > kSteepSlope * step.size * std::max(scale, kLeastSlopeScale);
  if (!damping_.isSmall(step.curvature) && !trouble_.empty() && is_steep)
    return stop(SolverStatus::stalled, cat("no step decreases the objective as predicted", trouble_));
  if (!takesUpConstraints(true)) converge();
}

/// Where the problem finds constraints that this point violates, or soon may, it goes on with them, and with all that
/// is known of the others. False if there are none.
bool AugmentedLagrangian::takesUpConstraints(bool is_solution) {
  if (refinements_ == kMostRefinements) return false;
  const Refinement found = function_.takeUpConstraints(here_, is_solution, filled_rows_);
  if (found == Refinement::much && is_solution) {
    stop(SolverStatus::stalled, "constraints that were not known before are violated by much");
    return true;
  }
  if (filled_rows_.empty()) return false;
  ++refinements_;
  if (options_.verbose > 1)
    std::printf("  evals %d  %zu rows taken up  violation %.3g\n", function_.evals(), filled_rows_.size(),
                here_.violation);
  for (std::size_t j = 0; j < constraints_.size(); ++j)
    if (std::ranges::find(filled_rows_, constraints_[j]) != filled_rows_.end()) lambda_[Eigen::Index(j)] = 0.;
  violation_.restart();
  tried_less_damping_ = false;
  trouble_.clear();
  model_is_stale_ = true;
  return true;
}

/// Do the constraints hold, or are they nearer to it after the step, to first order?
bool AugmentedLagrangian::helps(const Step& step) const {
  return holds(step.error) || (!holds(step.violation) && linearizedViolation() < kHelps * step.violation);
}

/// Is the inner problem solved? Right after a round a step that helps comes first, so that multipliers do not run away
/// from where they were computed.
bool AugmentedLagrangian::roundIsOver(const Step& step) const {
  const bool is_solved = inner_.isSolved(step.size, !damping_.isSmall(step.curvature)) || step.is_tiny ||
                         damping_.isLost() || step.predicted <= 0.;
  return is_solved && !(round_just_ended_ && step.predicted > 0. && !damping_.isLost() && helps(step));
}

/// Ends the round. True if the step is still to be tried: it helps and nearly meets the linearized constraints, the
/// penalty is the same, and with the new multipliers it is expected to go down, too.
bool AugmentedLagrangian::goesOnAfterRound(const Problem& problem, Step& step) {
  const bool helped = helps(step);
  if (damping_.isLost()) {
    damping_.restart();
    if (++times_lost_ == kMostLost) {
      stop(SolverStatus::stalled, cat("no step decreases the objective as predicted", trouble_));
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

/// New multipliers, and a larger penalty if the violation has not fallen enough.
void AugmentedLagrangian::endRound(const Step& step) {
  ++rounds_;
  round_just_ended_ = true;
  if (options_.verbose > 1)
    std::printf("  round %d  evals %d  cost %.6g  violation %.3g  mu %.3g\n", rounds_, function_.evals(), here_.cost,
                step.error, penalty_.value());
  if (!holds(step.error) && meetsContradiction(step)) return;
  updateMultipliers(step.size);
  if (!holds(step.error) && !violation_.fellEnough(step.error)) penalty_.grow();
  violation_.sawRound(step.error);
  inner_.tighten(options_.stopTolerance, holds(step.error));
  takesUpConstraints(false);
}

/// Where the violation does not fall under a large penalty, constraints may contradict each other. True if that ends
/// it: from here and from a point of least violation there is no way on, or going on has been in vain too often.
bool AugmentedLagrangian::meetsContradiction(const Step& step) {
  if (!violation_.isStuck(step.error, penalty_.isMuch())) return false;
  if (locallyInfeasible() && !restored()) {
    if (stopped_) return true;  // by the caller
    stop(SolverStatus::infeasible,
         cat("the constraints contradict each other here; least violation found ", function_.best().violation));
  } else if (violation_.isHopeless(step.error, here_.cost)) {
    stop(SolverStatus::stalled, cat("the violation no longer falls; it is ", step.error));
  }
  return stopped_;
}

/// To those of the model, unless the box kept its step short.
void AugmentedLagrangian::updateMultipliers(double step_size) {
  if (!radius_.leavesFree(step_size)) return;
  findMultipliers(model_.linearized(), next_lambda_);
  lambda_.swap(next_lambda_);
  if (options_.lambdaMax > 0.) lambda_ = lambda_.cwiseMin(options_.lambdaMax).cwiseMax(-options_.lambdaMax);
}

/// Evaluates the end of the step, or of its correction, and compares with what was predicted. False if the caller stops
/// it.
bool AugmentedLagrangian::tryStep(Step& step) {
  trial_.x = (here_.x + model_.step()).cwiseMax(lower_).cwiseMin(upper_);
  step.before = lagrangian(here_);
  if (!evaluate(trial_)) return false;
  step.after = lagrangian(trial_);
  const double rounding = std::max(kLeastRounding, kRounding * std::abs(step.before));
  was_corrected_ = false;
  const bool is_poor = trial_.finite && step.before - step.after < kPoor * step.predicted && step.predicted > rounding;
  if (is_poor && function_.evals() < options_.stopEvals && (!has_many_variables_ || isSpoiltByPenalties()) &&
      correction_.isDue()) {
    if (!correctTrial(step)) return false;
  }
  step.ratio = (step.before - step.after) / step.predicted;
  if (std::abs(step.before - step.after) < rounding &&
      step.predicted < rounding)  // only gradients tell which is better
    step.ratio = gradientNorm(trial_) < gradientNorm(here_) ? kFair : -1.;
  return true;
}

/// What the constraints at the trial point add to what the model said, is it due to their squares? That a correction can
/// take back. What multipliers make of it is curvature of the Lagrangian, which asks for shorter steps.
bool AugmentedLagrangian::isSpoiltByPenalties() {
  findMultipliers(model_.linearized(), next_lambda_);
  findMultipliers(trial_.c, multipliers_);
  multipliers_ -= next_lambda_;
  return multipliers_.squaredNorm() > 2. * next_lambda_.cwiseProduct(multipliers_).lpNorm<1>();
}

/// Where constraints are curved, a long step along their linearization leaves them. Solves the model again with the
/// constraints as they are at the trial point, and takes the corrected point as the trial if it is better. False if the
/// caller stops it. Source: Nocedal & Wright, ch. 18.3 (second-order correction).
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
  correction_.saw(was_corrected_);
  return true;
}

/// Of the model, along a step to its least value.
double AugmentedLagrangian::curvatureAlong(const Step& step) const {
  return 2. * step.predicted / model_.step().squaredNorm();
}

void AugmentedLagrangian::accept(const Step& step) {
  std::swap(here_, trial_);
  damping_.accept(step.ratio, was_corrected_);
  if (has_many_variables_) damping_.meet(step.ratio, Damping::lacking(step.ratio, curvatureAlong(step)));
  // Close to the solution, where the error falls as fast as Newton's method lets it, multipliers need no round.
  if (step.ratio > kGood && damping_.isSmall(step.curvature) && constraintError() <= kFastFall * step.error)
    updateMultipliers(step.size);
  inner_.sawStep(step.before, step.after);
  learnCurvature(trial_);
  radius_.accept(step.size, step.ratio > kVeryGood);
  tried_less_damping_ = round_just_ended_ = false;
  trouble_.clear();
  model_is_stale_ = true;
  function_.remember(here_);
}

/// The model stays, its next step is shorter.
void AugmentedLagrangian::refuse(const Step& step) {
  creep_.refuse();
  radius_.refuse();
  trouble_ =
      trial_.finite ? ", as at a kink" : cat(": where it would go, ", describeNotFinite(nlp_, trial_.phi, &trial_.J));
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

}  // namespace kinegraph
