#pragma once

#include <limits>

#include "kinegraph/solvers/algebra/local_model.h"
#include "kinegraph/solvers/algebra/quasi_newton.h"
#include "kinegraph/solvers/methods/augmented_lagrangian.h"
#include "kinegraph/solvers/problems/constrained_function.h"

namespace kinegraph {

/// What solutions of a problem hand on to the next.
struct AugmentedLagrangianMemory::Parts {
  explicit Parts(Nlp& nlp)
      : function(nlp),
        here(function.makePoint()),
        trial(here),
        corrected(here),
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

/// The method of solveAugmentedLagrangian, on its way.
class AugmentedLagrangian {
 public:
  using Memory = AugmentedLagrangianMemory::Parts;

  AugmentedLagrangian(Nlp& nlp, Memory& memory, const VectorXd& x0, const SolverOptions& options)
      : nlp_(nlp),
        options_(options),
        memory_(memory),
        constraints_(function_.constraints()),
        equalities_(function_.equalities()),
        lower_(function_.lower()),
        upper_(function_.upper()),
        tolerance_(options.constraintTolerance()) {
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
      stop(here_.violation <= tolerance_ ? SolverStatus::converged : SolverStatus::infeasible,
           "there is nothing to vary");
    } else if (!solvedInOneStep()) {
      iterate();
    }
    return function_.result(status_ == SolverStatus::converged ? here_ : function_.best(), lambda_, status_, message_);
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

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
      worst = std::max(
          worst, here_.c.tail(inequalities).cwiseMax(-1. / mu_ * lambda_.tail(inequalities)).lpNorm<Eigen::Infinity>());
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

  /// Where the problem does not tell the curvature of its f terms, that of the Lagrangian is learnt from accepted
  /// steps.
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
  VectorXd &start_ = memory_.start, &lambda_ = memory_.lambda, &next_lambda_ = memory_.next_lambda,
           &multipliers_ = memory_.multipliers;
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
  double mu_ = 1., omega_ = .1, last_violation_ = kInfinity, violation_at_tests_ = kInfinity,
         cost_at_tests_ = kInfinity, rel_ = .02;
  int rounds_ = 0, bad_rounds_ = 0, failed_tests_ = 0;
  bool round_just_ended_ = false, is_warm_ = false;
  bool stopped_ = false;
  SolverStatus status_ = SolverStatus::stalled;
  std::string message_;
  std::string trouble_;  ///< why the last step was rejected; empty if it was not
};

}  // namespace kinegraph
