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

constexpr double kEnough = .02;  ///< part of the violation that a step may leave, to first order
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What solutions of a problem hand on to the next.
struct Memory {
  explicit Memory(Nlp& nlp)
      : function(nlp), here(function.makePoint()), trial(here), corrected(here),
        model(makeLocalModel(nlp, here.J, function.costs(), function.constraints())) {
    for (EvaluatedPoint* copy : {&trial, &corrected}) copy->J.values.reserve(here.J.values.capacity());
    for (VectorXd* v : {&start, &low, &high, &gradient}) v->setZero(here.x.size());
    for (VectorXd* v : {&lambda, &next_lambda, &multipliers}) v->setZero(here.c.size());
  }

  ConstrainedFunction function;
  EvaluatedPoint here, trial, corrected;
  std::unique_ptr<LocalModel> model;
  VectorXd start, lambda, next_lambda, multipliers, low, high, gradient;
  double damping = 0.;  ///< at the end of the last solution; 0 where it did not converge
};

class AugmentedLagrangian {
 public:
  AugmentedLagrangian(Nlp& nlp, Memory& memory, const VectorXd& x0, const SolverOptions& options)
      : nlp_(nlp), options_(options), memory_(memory), constraints_(function_.constraints()), equalities_(function_.equalities()),
        lower_(function_.lower()), upper_(function_.upper()), tolerance_(options.constraintTolerance()) {
    here_.x = start_ = x0.cwiseMax(lower_).cwiseMin(upper_);
    lambda_.setZero();
  }

  SolverResult run(const VectorXd& dual) {
    if (function_.hasGeneralCosts()) curvature_.reset(nlp_.dimension());
    is_warm_ = dual.size() == here_.phi.size();
    if (is_warm_) {
      for (std::size_t j = 0; j < constraints_.size(); ++j) lambda_[Eigen::Index(j)] = dual[constraints_[j]];
    }
    evaluate(here_);
    function_.requireFiniteStart(here_);
    function_.remember(here_);
    weight_ = costWeight();
    mu_ = weight_ * options_.muInit;
    if (nlp_.dimension() == 0) {
      stop(here_.violation <= tolerance_ ? SolverStatus::converged : SolverStatus::infeasible, "there is nothing to vary");
    } else if (!solvedInOneStep()) {
      iterate();
    }
    return function_.result(status_ == SolverStatus::converged ? here_ : function_.best(), lambda_, status_, message_);
  }

 private:
  bool solvedInOneStep();
  void iterate();
  void endRound(double vc, double step_size);
  void updateMultipliers(double step_size);
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

  void converge(double damping) {
    memory_.damping = damping;
    stop(SolverStatus::converged, "step, predicted decrease and violation are within their tolerances");
  }

  bool evaluate(EvaluatedPoint& point) {
    if (function_.evaluate(point)) return true;
    stop(SolverStatus::cancelled, "cancelled by the caller");
    return false;
  }

  /// lambda + mu c, cut off at zero for inequalities.
  void findMultipliers(const VectorXd& c, VectorXd& t) const {
    t = lambda_ + mu_ * c;
    t.tail(t.size() - equalities_) = t.tail(t.size() - equalities_).cwiseMax(0.);
  }

  /// Sum of the squares of lambda + mu c, cut off at zero for inequalities.
  double squaredMultipliers(const VectorXd& c) const {
    const Eigen::Index inequalities = c.size() - equalities_;
    return (lambda_.head(equalities_) + mu_ * c.head(equalities_)).squaredNorm() +
           (lambda_.tail(inequalities) + mu_ * c.tail(inequalities)).cwiseMax(0.).squaredNorm();
  }

  /// Without the constant -lambda^2 / (2 mu).
  double lagrangian(const EvaluatedPoint& point) const {
    return point.finite ? point.cost + squaredMultipliers(point.c) / (2. * mu_) : kInfinity;
  }

  /// The violation that the model expects after its step.
  double linearizedViolation() const { return worst(model_.linearized()); }

  double worst(const VectorXd& c) const {
    const Eigen::Index inequalities = c.size() - equalities_;
    double worst = equalities_ > 0 ? c.head(equalities_).lpNorm<Eigen::Infinity>() : 0.;
    if (inequalities > 0) worst = std::max(worst, c.tail(inequalities).maxCoeff());
    return worst;
  }

  /// Sum of squares of violations.
  double squaredViolation(const VectorXd& c) const {
    return c.head(equalities_).squaredNorm() + c.tail(c.size() - equalities_).cwiseMax(0.).squaredNorm();
  }

  /// Largest entry of the gradient of the Lagrangian, as far as the bounds leave room to go down.
  double gradientNorm(const EvaluatedPoint& point) {
    function_.costGradient(point.phi, point.J, gradient_);
    findMultipliers(point.c, multipliers_);
    function_.addConstraintGradient(point.J, multipliers_, gradient_);
    return ((point.x - gradient_).cwiseMax(lower_).cwiseMin(upper_) - point.x).lpNorm<Eigen::Infinity>();
  }

  /// Violation and failure of complementarity.
  double optimalityError() const {
    const Eigen::Index inequalities = here_.c.size() - equalities_;
    double worst = equalities_ > 0 ? here_.c.head(equalities_).lpNorm<Eigen::Infinity>() : 0.;
    if (inequalities > 0) {
      worst = std::max(worst, here_.c.tail(inequalities).cwiseMax(-1. / mu_ * lambda_.tail(inequalities)).lpNorm<Eigen::Infinity>());
    }
    return worst;
  }

  void linearize() {
    model_.setJacobian(here_.J);
    learns_curvature_ = !model_.setCosts(nlp_, here_.x, here_.phi, &curvature_.matrix());
  }

  void addCurvature() {
    if (learns_curvature_ || nlp_.curvedRows().empty()) return;
    function_.moveTo(here_);
    model_.addCurvature(nlp_, lambda_);
  }

  /// Where the problem does not tell the curvature of its f terms, that of the Lagrangian is learnt from accepted steps.
  void learnCurvature(const EvaluatedPoint& before) {
    if (!learns_curvature_) return;
    findMultipliers(model_.linearized(), next_lambda_);
    VectorXd old_gradient;
    function_.generalGradient(before.J, next_lambda_, old_gradient);
    function_.generalGradient(here_.J, next_lambda_, gradient_);
    curvature_.update(here_.x - before.x, gradient_ - old_gradient);
  }

  void box() {
    low_ = (lower_ - here_.x).cwiseMax(-radius_);
    high_ = (upper_ - here_.x).cwiseMin(radius_);
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
    function_.generalGradient(here_.J, VectorXd(), gradient_);
    return std::max(1., .01 * gradient_.lpNorm<Eigen::Infinity>());
  }

  Nlp& nlp_;
  const SolverOptions& options_;
  Memory& memory_;
  ConstrainedFunction& function_ = memory_.function;
  EvaluatedPoint &here_ = memory_.here, &trial_ = memory_.trial, &corrected_ = memory_.corrected;
  LocalModel& model_ = *memory_.model;
  QuasiNewton curvature_;
  bool learns_curvature_ = false;
  const std::vector<int>& constraints_;  ///< rows, equalities first
  const int equalities_;
  const VectorXd &lower_, &upper_;
  VectorXd &start_ = memory_.start, &lambda_ = memory_.lambda, &next_lambda_ = memory_.next_lambda, &multipliers_ = memory_.multipliers;
  VectorXd &low_ = memory_.low, &high_ = memory_.high, &gradient_ = memory_.gradient;
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
  double mu_ = 1., omega_ = .1, last_violation_ = kInfinity, violation_at_tests_ = kInfinity, cost_at_tests_ = kInfinity, rel_ = .02;
  int rounds_ = 0, bad_rounds_ = 0, failed_tests_ = 0;
  bool round_just_ended_ = false, is_warm_ = false;
  bool stopped_ = false;
  SolverStatus status_ = SolverStatus::stalled;
  std::string message_;
  std::string trouble_;  ///< why the last step was rejected; empty if it was not
};

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
  if (!evaluate(trial_) || !trial_.finite || !isSolution(function_, trial_.x, trial_.phi, trial_.J, step->multipliers)) return false;
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
    if (function_.evals() >= options_.stopEvals) return stop(SolverStatus::limit, cat("limit of ", options_.stopEvals, " evaluations"));
    if (step >= 20 * options_.stopInners) return stop(SolverStatus::limit, cat("limit of ", options_.stopInners, " steps"));
    if (rounds_ >= options_.stopOuters) return stop(SolverStatus::limit, cat("limit of ", options_.stopOuters, " rounds"));
    if (model_is_stale) linearize();
    const double h = model_.largestCurvature(), vc = optimalityError(), violation = here_.violation;
    box();
    const LocalModel::Problem problem{here_.c, lambda_, mu_, nu, low_, high_, passes};
    if (model_is_stale && step > 0 && vc <= tolerance_ && nu <= .1 * h && trouble_.empty() && model_.estimateStep(problem) <= tolerance) {
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
      return converge(nu);
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
    if (trial_.finite && before - after < .5 * predicted && predicted > noise && function_.evals() < options_.stopEvals) {
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
      if (ratio > .7 && nu <= .1 * h && optimalityError() <= .25 * vc) updateMultipliers(size);  // close: no need to solve it first
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
      trouble_ = trial_.finite ? ", as at a kink" : cat(": where it would go, ", describeNotFinite(nlp_, trial_.phi, &trial_.J));
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
  corrected_.x = trial_.x - here_.x;
  corrected_.c = trial_.c;
  for (std::size_t j = 0; j < constraints_.size(); ++j) corrected_.c[Eigen::Index(j)] -= here_.J.rowTimes(constraints_[j], corrected_.x);
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

/// True if the constraints hold, steps are refused again and again, and those that are not hardly decrease the costs: less
/// than one in 1 / tolerance an evaluation.
bool AugmentedLagrangian::creeps(double vc) {
  constexpr int kWindow = 10, kRefused = 3;
  const int evals = function_.evals();
  const double now = here_.cost;
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
  if (options_.verbose > 1) std::printf("  round %d  evals %d  cost %.6g  violation %.3g  mu %.3g\n", rounds_, function_.evals(), here_.cost, vc, mu_);
  if (vc > tolerance_) {
    bad_rounds_ = vc > .7 * last_violation_ && mu_ >= 1e3 * weight_ * options_.muInit ? bad_rounds_ + 1 : 0;
    if (bad_rounds_ >= 2) {
      if (locallyInfeasible() && !restored()) {
        return stop(SolverStatus::infeasible, cat("the constraints contradict each other here; least violation found ", function_.best().violation));
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

/// Goes to a point of least violation, from here or else from the start. True if the violation is much less there, so that it
/// can go on, with a larger penalty.
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
    trial_.x = (here_.x + model_.minimize({here_.c, next_lambda_, 1., damping, low_, high_, 12})).cwiseMax(lower_).cwiseMin(upper_);
    if (!evaluate(trial_)) return;
    const double before = squaredViolation(here_.c), after = squaredViolation(trial_.c), expected = squaredViolation(model_.linearized());
    const bool at_edge = model_.step().lpNorm<Eigen::Infinity>() >= .99 * radius_, good = before - after > .5 * (before - expected);
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

struct AugmentedLagrangianMemory::Parts : Memory {
  using Memory::Memory;
};

AugmentedLagrangianMemory::AugmentedLagrangianMemory() = default;
AugmentedLagrangianMemory::~AugmentedLagrangianMemory() = default;

SolverResult solveAugmentedLagrangian(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const VectorXd& dual,
                                      const EvaluationHook& hook, AugmentedLagrangianMemory* memory) {
  AugmentedLagrangianMemory own;
  auto& parts = (memory ? memory : &own)->parts;
  if (!parts) parts = std::make_unique<AugmentedLagrangianMemory::Parts>(nlp);
  parts->function.begin(x0, options, hook);
  return AugmentedLagrangian(nlp, *parts, x0, options).run(dual);
}

}  // namespace kinegraph
