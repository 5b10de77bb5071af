#include "kinegraph/solvers/augmented_lagrangian.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/solvers/constrained_function.h"
#include "kinegraph/solvers/local_model.h"
#include "kinegraph/solvers/quadratic_step.h"
#include "kinegraph/solvers/quasi_newton.h"

namespace kinegraph {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class AugmentedLagrangian {
 public:
  AugmentedLagrangian(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationHook& hook)
      : nlp_(nlp), options_(options), function_(nlp, x0, options, hook), model_(nlp, function_.costs(), function_.constraints()),
        constraints_(function_.constraints()), lower_(function_.lower()), upper_(function_.upper()), J_(nlp.makeJacobian()),
        trial_J_(J_), corrected_J_(J_), phi_(VectorXd::Zero(Eigen::Index(nlp.types().size()))), trial_phi_(phi_),
        lambda_(VectorXd::Zero(Eigen::Index(constraints_.size()))), next_lambda_(lambda_), tolerance_(options.constraintTolerance()) {
    x_ = start_ = trial_ = corrected_ = gradient_ = function_.clip(x0);
    corrected_phi_ = phi_;
    low_ = high_ = gradient_;
  }

  SolverResult run(const VectorXd& dual) {
    if (function_.hasGeneralCosts()) curvature_.reset(nlp_.dimension());
    if (dual.size() == phi_.size()) {
      for (std::size_t j = 0; j < constraints_.size(); ++j) lambda_[j] = dual[constraints_[j]];
    }
    evaluate(x_, phi_, J_);
    function_.requireFiniteStart(phi_, J_);
    function_.remember(x_, phi_);
    weight_ = costWeight();
    mu_ = weight_ * options_.muInit;
    if (nlp_.dimension() == 0) {
      stop(violationAt(phi_) <= tolerance_ ? SolverStatus::converged : SolverStatus::infeasible, "there is nothing to vary");
    } else if (!solvedInOneStep()) {
      iterate();
    }
    if (status_ != SolverStatus::converged) {
      x_ = function_.best();
      phi_ = function_.bestPhi();
    }
    return function_.result(x_, phi_, lambda_, status_, message_);
  }

 private:
  bool solvedInOneStep();
  void iterate();
  void endRound(double vc, double step_size);
  bool correctTrial(double& value, double size, double shift, int passes);
  bool creeps(double vc);
  bool locallyInfeasible();
  bool restored();
  void reduceViolation();

  void stop(SolverStatus status, std::string message) {
    status_ = status;
    message_ = std::move(message);
    stopped_ = true;
  }

  bool evaluate(const VectorXd& x, VectorXd& phi, Jacobian& J) {
    if (function_.evaluate(x, phi, J)) return true;
    stop(SolverStatus::cancelled, "cancelled by the caller");
    return false;
  }

  double cost(const VectorXd& phi) const { return function_.cost(phi); }

  double multiplier(int j, double c) const {
    return model_.isEquality(j) ? lambda_[j] + mu_ * c : std::max(0., lambda_[j] + mu_ * c);
  }

  double penalty(int j, double c) const {  // 1/(2 mu) t^2, without the constant -lambda^2
    const double t = multiplier(j, c);
    return t * t / (2. * mu_);
  }

  double lagrangian(const VectorXd& phi) const {
    double sum = cost(phi);
    for (int j = 0; j < lambda_.size(); ++j) sum += penalty(j, phi[constraints_[j]]);
    return sum;
  }

  double violationAt(const VectorXd& phi) const { return function_.violation(phi); }

  /// The violation that the model expects after its step.
  double linearizedViolation() const {
    double worst = 0.;
    for (int j = 0; j < lambda_.size(); ++j) {
      worst = std::max(worst, model_.isEquality(j) ? std::abs(model_.linearized()[j]) : model_.linearized()[j]);
    }
    return worst;
  }

  /// Largest entry of the gradient of the Lagrangian, as far as the bounds leave room to go down.
  double gradientNorm(const VectorXd& x, const VectorXd& phi, const Jacobian& J) {
    function_.costGradient(phi, J, gradient_);
    for (int j = 0; j < lambda_.size(); ++j) J.addRowTo(constraints_[j], multiplier(j, phi[constraints_[j]]), gradient_);
    return ((x - gradient_).cwiseMax(lower_).cwiseMin(upper_) - x).lpNorm<Eigen::Infinity>();
  }

  /// Violation and failure of complementarity.
  double optimalityError() const {
    double worst = 0.;
    for (int j = 0; j < lambda_.size(); ++j) {
      const double c = phi_[constraints_[j]];
      worst = std::max(worst, std::abs(model_.isEquality(j) ? c : std::max(c, -lambda_[j] / mu_)));
    }
    return worst;
  }

  void setCosts() { learns_curvature_ = !model_.setCosts(nlp_, x_, phi_, J_, &curvature_.matrix()); }

  /// Where the problem does not tell the curvature of its f terms, that of the Lagrangian is learnt from accepted steps.
  void learnCurvature(const VectorXd& before, const Jacobian& J_before) {
    if (!learns_curvature_) return;
    for (int j = 0; j < lambda_.size(); ++j) next_lambda_[j] = multiplier(j, model_.linearized()[j]);
    VectorXd old_gradient;
    function_.generalGradient(J_before, next_lambda_, old_gradient);
    function_.generalGradient(J_, next_lambda_, gradient_);
    curvature_.update(x_ - before, gradient_ - old_gradient);
  }

  void box() {
    low_ = (lower_ - x_).cwiseMax(-radius_);
    high_ = (upper_ - x_).cwiseMin(radius_);
  }

  /// Steps that reach the edge of the box and do what was predicted, twice in a row, may become longer.
  void adaptRadius(double size, bool good, bool rejected) {
    if (rejected) radius_ = std::max(options_.stepMax, .25 * radius_);
    steps_at_edge_ = good && size >= .99 * radius_ ? steps_at_edge_ + 1 : 0;
    if (steps_at_edge_ >= 2) radius_ = std::min(2. * radius_, 1e6 * options_.stepMax);
  }

  /// Where the costs are steep, as numbers without a unit may be, penalties must be as well. 1 for sums of squares.
  double costWeight() {
    if (!function_.hasGeneralCosts()) return 1.;
    function_.generalGradient(J_, VectorXd(), gradient_);
    return std::max(1., .01 * gradient_.lpNorm<Eigen::Infinity>());
  }

  Nlp& nlp_;
  const SolverOptions& options_;
  ConstrainedFunction function_;
  LocalModel model_;
  QuasiNewton curvature_;
  bool learns_curvature_ = false;
  const std::vector<int>& constraints_;
  const VectorXd &lower_, &upper_;
  Jacobian J_, trial_J_, corrected_J_;
  VectorXd x_, start_, phi_, trial_, trial_phi_, corrected_, corrected_phi_, lambda_, next_lambda_, low_, high_, gradient_;
  double tolerance_;
  double weight_ = 1., radius_ = options_.stepMax;
  int steps_at_edge_ = 0, restorations_ = 0;
  /// Evaluations since when the constraints hold.
  struct {
    int first = 0, refused = 0;
    double cost = kInfinity;
  } slow_;
  struct {
    int wait = 0, failures = 0;
    bool helped = false;
  } correction_;
  double mu_ = 1., omega_ = .1, last_violation_ = kInfinity, violation_at_tests_ = kInfinity, rel_ = .02;
  int rounds_ = 0, bad_rounds_ = 0, failed_tests_ = 0;
  bool round_just_ended_ = false;
  bool stopped_ = false;
  SolverStatus status_ = SolverStatus::stalled;
  std::string message_;
  std::string trouble_;  ///< why the last step was rejected; empty if it was not
};

/// Goes to the solution of the linearized problem, if that is the solution of the problem.
bool AugmentedLagrangian::solvedInOneStep() {
  if (options_.stopEvals < 2 || !nlp_.mayBeQuadratic()) return false;
  std::optional<QuadraticStep> step = quadraticStep(function_, x_, phi_, J_);
  if (!step && constraints_.empty()) {
    setCosts();
    if (learns_curvature_) return false;
    low_ = lower_ - x_;
    high_ = upper_ - x_;
    step = {x_ + model_.minimize({phi_, J_, lambda_, 1., 0., low_, high_, 12}), {}};
  }
  if (!step || !evaluate(step->x, trial_phi_, trial_J_) || !describeNotFinite(nlp_, trial_phi_, &trial_J_).empty()) return false;
  if (!isSolution(function_, step->x, trial_phi_, trial_J_, step->multipliers)) return false;
  x_ = step->x;
  phi_.swap(trial_phi_);
  lambda_ = step->multipliers;
  stop(SolverStatus::converged, "the problem is quadratic; one step solves it");
  return true;
}

void AugmentedLagrangian::iterate() {
  const double first_nu = weight_ * options_.damping;
  double nu = first_nu, growth = 2., last_relative = 1.;
  bool damped_step_retried = false, costs_stale = true;
  int given_up = 0;
  const double tolerance = options_.stopTolerance;
  const int passes = nlp_.dimension() > 100 ? 3 : 12;
  for (int step = 0; !stopped_; ++step) {
    if (function_.evals() >= options_.stopEvals) return stop(SolverStatus::limit, cat("limit of ", options_.stopEvals, " evaluations"));
    if (step >= 20 * options_.stopInners) return stop(SolverStatus::limit, cat("limit of ", options_.stopInners, " steps"));
    if (rounds_ >= options_.stopOuters) return stop(SolverStatus::limit, cat("limit of ", options_.stopOuters, " rounds"));
    if (costs_stale) setCosts();
    costs_stale = false;
    const double h = model_.largestCurvature();
    box();
    const VectorXd& d = model_.minimize({phi_, J_, lambda_, mu_, nu, low_, high_, passes});
    const double size = d.lpNorm<Eigen::Infinity>();
    double predicted = -model_.costChange();
    for (int j = 0; j < lambda_.size(); ++j) predicted += penalty(j, phi_[constraints_[j]]) - penalty(j, model_.linearized()[j]);
    const double vc = optimalityError(), violation = violationAt(phi_);
    const double scale = std::max(std::abs(cost(phi_)), 1e-4);
    const bool tiny = size <= tolerance || predicted <= std::max(tolerance * tolerance, 1e-16) * scale;
    if (options_.verbose > 2) {
      std::printf("    step %3d  evals %3d  |d| %.3g  predicted %.3g  violation %.3g  mu %.3g  nu %.3g\n", step, function_.evals(), size, predicted, vc, mu_, nu);
    }
    if (creeps(vc)) return stop(SolverStatus::stalled, cat("the costs hardly fall any more, as along a kink", trouble_));
    if (tiny && nu > .1 * h && nu < 1e8 && (!damped_step_retried || trouble_.empty())) {
      nu = std::max(.1 * h, .01 * nu);  // it may be small because of the damping, not because of the problem
      growth = 2.;
      damped_step_retried = true;
      trouble_.clear();
      continue;
    }
    if (tiny && vc <= tolerance_) {
      if (nu > .1 * h && !trouble_.empty() && predicted > .1 * size * std::max(scale, .01)) {  // larger steps were refused
        return stop(SolverStatus::stalled, cat("no step decreases the objective as predicted", trouble_));
      }
      return stop(SolverStatus::converged, cat("step ", size, ", its predicted decrease ", predicted, ", and violation ", vc, " are within tolerances"));
    }
    const bool solved = (size <= omega_ && nu <= .1 * h) || last_relative <= rel_ || tiny || nu > 1e10 || predicted <= 0.;
    const bool helps = vc <= tolerance_ || (violation > tolerance_ && linearizedViolation() < .5 * violation);
    if (solved && !(round_just_ended_ && helps && predicted > 0. && nu <= 1e10)) {
      if (nu > 1e10) {
        nu = first_nu;
        if (++given_up == 3) return stop(SolverStatus::stalled, cat("no step decreases the objective as predicted", trouble_));
      }
      endRound(vc, size);
      last_relative = 1.;
      continue;
    }
    trial_ = (x_ + d).cwiseMax(lower_).cwiseMin(upper_);
    const double before = lagrangian(phi_);
    if (!evaluate(trial_, trial_phi_, trial_J_)) return;
    const std::string not_finite = describeNotFinite(nlp_, trial_phi_, &trial_J_);
    double after = not_finite.empty() ? lagrangian(trial_phi_) : kInfinity;
    const double noise = std::max(1e-12, 1e-10 * std::abs(before));
    correction_.helped = false;
    if (not_finite.empty() && before - after < .5 * predicted && predicted > noise && function_.evals() < options_.stopEvals) {
      if (!correctTrial(after, size, nu, passes)) return;
    }
    double ratio = (before - after) / predicted;
    if (std::abs(before - after) < noise && predicted < noise) {  // only gradients tell which point is better
      ratio = gradientNorm(trial_, trial_phi_, trial_J_) < gradientNorm(x_, phi_, J_) ? .3 : -1.;
    }
    if (ratio > options_.wolfe) {
      x_.swap(trial_);
      phi_.swap(trial_phi_);
      std::swap(J_, trial_J_);
      const bool was_refused = growth > 2.;  // a step with less damping, from this point
      nu = std::max(1e-6, nu * std::max(was_refused || correction_.helped ? .5 : .1, 1. - std::pow(2. * std::min(ratio, 1.2) - 1., 3)));
      growth = 2.;
      last_relative = (before - after) / std::max(std::abs(before), .01);
      learnCurvature(trial_, trial_J_);
      adaptRadius(size, ratio > .75, false);
      damped_step_retried = round_just_ended_ = false;
      trouble_.clear();
      costs_stale = true;
      function_.remember(x_, phi_);
    } else {
      ++slow_.refused;
      adaptRadius(size, false, true);
      trouble_ = not_finite.empty() ? ", as at a kink" : cat(": where it would go, ", not_finite);
      nu = std::max({nu * growth, .0001 * h, 1e-3});
      growth *= 2.;
    }
  }
}

/// Where constraints are curved, a long step along their linearization leaves them. Solves the model again with the constraints
/// as they are at the trial point, and takes the corrected point as the trial if it is better. `value` is the Lagrangian at
/// the trial point. False if the caller stops it. Source: Nocedal & Wright, ch. 18.3 (second-order correction).
bool AugmentedLagrangian::correctTrial(double& value, double size, double shift, int passes) {
  if (correction_.wait > 0) {
    --correction_.wait;
    return true;
  }
  corrected_phi_ = phi_;
  corrected_ = trial_ - x_;
  for (int row : constraints_) corrected_phi_[row] = trial_phi_[row] - J_.rowTimes(row, corrected_);
  const VectorXd& d = model_.minimize({corrected_phi_, J_, lambda_, mu_, shift, low_, high_, passes});
  corrected_ = (x_ + d).cwiseMax(lower_).cwiseMin(upper_);
  bool better = (corrected_ - trial_).lpNorm<Eigen::Infinity>() <= .5 * size;
  if (better) {
    if (!evaluate(corrected_, corrected_phi_, corrected_J_)) return false;
    const double corrected = describeNotFinite(nlp_, corrected_phi_, &corrected_J_).empty() ? lagrangian(corrected_phi_) : kInfinity;
    better = corrected < value;
    if (better) {
      value = corrected;
      trial_.swap(corrected_);
      trial_phi_.swap(corrected_phi_);
      std::swap(trial_J_, corrected_J_);
    }
  }
  correction_.helped = better;
  correction_.failures = better ? 0 : correction_.failures + 1;
  if (correction_.failures >= 2) correction_.wait = std::min(2 << correction_.failures, 32);
  return true;
}

/// True if the constraints hold, steps are refused again and again, and those that are not hardly decrease the costs: less
/// than one in 1 / tolerance an evaluation.
bool AugmentedLagrangian::creeps(double vc) {
  constexpr int kWindow = 10, kRefused = 3;
  const int evals = function_.evals();
  const double now = cost(phi_);
  if (constraints_.empty() || (vc <= tolerance_ && evals < slow_.first + kWindow)) return false;
  const double least = kWindow * std::min(options_.stopTolerance, options_.stopFTolerance) * std::max(std::abs(now), 1e-4);
  const bool slow = vc <= tolerance_ && slow_.refused >= kRefused && slow_.cost - now < least;
  slow_ = {evals, 0, now};
  return slow;
}

/// An inner problem is solved well enough: new multipliers, and a larger penalty if the violation has not fallen.
void AugmentedLagrangian::endRound(double vc, double step_size) {
  ++rounds_;
  round_just_ended_ = true;
  if (options_.verbose > 1) std::printf("  round %d  evals %d  cost %.6g  violation %.3g  mu %.3g\n", rounds_, function_.evals(), cost(phi_), vc, mu_);
  if (vc > tolerance_) {
    bad_rounds_ = vc > .7 * last_violation_ && mu_ >= 1e3 * weight_ * options_.muInit ? bad_rounds_ + 1 : 0;
    if (bad_rounds_ >= 2) {
      if (locallyInfeasible() && !restored()) {
        return stop(SolverStatus::infeasible, cat("the constraints contradict each other here; least violation found ", function_.bestViolation()));
      }
      bad_rounds_ = 0;
      if (vc < .5 * violation_at_tests_) {  // slow, but it falls
        violation_at_tests_ = vc;
        failed_tests_ = 0;
      }
      if (++failed_tests_ == 6) return stop(SolverStatus::stalled, cat("the violation no longer falls; it is ", vc));
    }
  }
  if (step_size <= .5 * radius_) {
    for (int j = 0; j < lambda_.size(); ++j) lambda_[j] = multiplier(j, model_.linearized()[j]);
    if (options_.lambdaMax > 0.) lambda_ = lambda_.cwiseMin(options_.lambdaMax).cwiseMax(-options_.lambdaMax);
  }
  if (vc > .25 * last_violation_ && vc > tolerance_) mu_ = std::min(weight_ * options_.muMax, options_.muInc * mu_);
  last_violation_ = std::min(last_violation_, vc);
  omega_ = std::max(.3 * omega_, options_.stopTolerance);
  if (vc <= tolerance_) rel_ = std::max(.5 * rel_, 1e-6);
}

/// True if no step reduces the linearized violation by a tenth.
bool AugmentedLagrangian::locallyInfeasible() {
  next_lambda_.setZero();
  double largest_row = 1e-6;
  for (double value : J_.values) largest_row = std::max(largest_row, value * value);
  model_.setNoCosts(1e-6 * largest_row);
  box();
  model_.minimize({phi_, J_, next_lambda_, 1., 0., low_, high_, 12});
  double before = 0., after = 0.;
  for (int j = 0; j < lambda_.size(); ++j) {
    const double c = phi_[constraints_[j]], linear = model_.linearized()[j];
    before += model_.isEquality(j) ? c * c : std::pow(std::max(0., c), 2);
    after += model_.isEquality(j) ? linear * linear : std::pow(std::max(0., linear), 2);
  }
  setCosts();
  return std::sqrt(after) >= .9 * std::sqrt(before);
}

/// Goes to a point of least violation, from here or else from the start. True if the violation is much less there, so that it
/// can go on, with a larger penalty.
bool AugmentedLagrangian::restored() {
  const double before = violationAt(phi_), enough = std::max(.5 * before, .1 * tolerance_);
  reduceViolation();
  if (!stopped_ && ++restorations_ == 1 && violationAt(phi_) > enough) {
    const VectorXd here = x_, phi_here = phi_;
    x_ = start_;
    if (!evaluate(x_, phi_, J_)) return false;
    reduceViolation();
    if (!stopped_ && violationAt(phi_) > enough && violationAt(phi_here) <= violationAt(phi_)) {
      x_ = here;
      phi_ = phi_here;
    }
  }
  function_.forceBest(x_, phi_);
  if (stopped_ || restorations_ > 5 || function_.bestViolation() > enough) return false;
  lambda_.setZero();
  mu_ = std::min(weight_ * options_.muMax, std::pow(10., restorations_) * weight_ * options_.muInit);
  last_violation_ = violation_at_tests_ = kInfinity;
  setCosts();
  return true;
}

/// Gauss-Newton steps on the violation alone, so that the answer is the least one and no compromise with the costs.
void AugmentedLagrangian::reduceViolation() {
  const auto square = [&](const VectorXd& phi) {
    double sum = 0.;
    for (int row : constraints_) sum += std::pow(violation(nlp_.types()[row], phi[row]), 2);
    return sum;
  };
  next_lambda_.setZero();
  double damping = 1e-4;
  for (int step = 0; step < 30 && function_.evals() < options_.stopEvals; ++step) {
    model_.setNoCosts(0.);
    box();
    trial_ = (x_ + model_.minimize({phi_, J_, next_lambda_, 1., damping, low_, high_, 12})).cwiseMax(lower_).cwiseMin(upper_);
    if (!evaluate(trial_, trial_phi_, trial_J_)) return;
    const double before = square(phi_), after = square(trial_phi_);
    double expected = 0.;
    for (int j = 0; j < lambda_.size(); ++j) {
      const double c = model_.linearized()[j];
      expected += model_.isEquality(j) ? c * c : std::pow(std::max(0., c), 2);
    }
    const bool at_edge = model_.step().lpNorm<Eigen::Infinity>() >= .99 * radius_, good = before - after > .5 * (before - expected);
    if (at_edge && good) radius_ *= 4.;
    if (!good) radius_ = std::max(options_.stepMax, .25 * radius_);
    if (before - expected < 1e-4 * before && !at_edge && damping <= 1e-4 * (1. + before)) return;
    if (!(after < before) || !describeNotFinite(nlp_, trial_phi_, &trial_J_).empty()) {
      damping *= 10.;
      continue;
    }
    x_.swap(trial_);
    phi_.swap(trial_phi_);
    std::swap(J_, trial_J_);
    damping *= .1;
    if (std::sqrt(after) < .1 * tolerance_) return;
  }
}

}  // namespace

void requireStart(const Nlp& nlp, const VectorXd& x0) {
  if (x0.size() != nlp.dimension()) {
    throw ValueError(cat("the start has ", x0.size(), " numbers; the problem has ", nlp.dimension(), " variables"));
  }
  if (!x0.allFinite()) throw ValueError("the start has numbers that are not finite");
}

void requireNoConstraints(const Nlp& nlp, const char* method) {
  for (int row = 0; row < int(nlp.types().size()); ++row) {
    const ObjectiveType type = nlp.types()[row];
    if (type != ObjectiveType::eq && type != ObjectiveType::ineq && type != ObjectiveType::ineqB) continue;
    throw ValueError(cat("OptMethod.", method, " takes no constraints; ", nlp.rowName(row),
                         " is one; use augmentedLag, squaredPenalty, logBarrier or slackGN_logBarrier"));
  }
}

SolverResult solveAugmentedLagrangian(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const VectorXd& dual,
                                      const EvaluationHook& hook) {
  return AugmentedLagrangian(nlp, x0, options, hook).run(dual);
}

}  // namespace kinegraph
