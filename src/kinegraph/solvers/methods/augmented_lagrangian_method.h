#pragma once

#include <limits>
#include <string_view>

#include "kinegraph/solvers/algebra/local_model.h"
#include "kinegraph/solvers/algebra/quasi_newton.h"
#include "kinegraph/solvers/methods/augmented_lagrangian.h"
#include "kinegraph/solvers/methods/damping.h"
#include "kinegraph/solvers/methods/penalty.h"
#include "kinegraph/solvers/methods/step_radius.h"
#include "kinegraph/solvers/methods/stopping_rules.h"
#include "kinegraph/solvers/problems/constrained_function.h"

namespace kinegraph {

/// The memory that solves of a problem share. It stays below 1032 bytes, up to which glibc caches freed memory; above,
/// the solve of a new small problem takes 3 % more instructions.
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
  double damping = 0.;  ///< at the end of the last solve; 0 if it did not converge
  double penalty = 0.;  ///< at the end of the last solve
  std::string message;  ///< the reason of its end
};

}  // namespace kinegraph

namespace kinegraph::inline solvers_internal {

/// The implementation of solveAugmentedLagrangian. `c` (constraints, equalities first), `cost` and `lagrangian` are h,
/// f and L of Nocedal & Wright, ch. 17.4; lambda and mu are theirs.
class AugmentedLagrangian {
 public:
  using Memory = AugmentedLagrangianMemory::Parts;

  AugmentedLagrangian(Nlp& nlp, Memory& memory, const VectorXd& x0, const SolverOptions& options);

  SolverResult run(const VectorXd& dual);

  /// Solves without creating a result: the memory holds the last point and multipliers as `here` and `lambda`.
  void search(const VectorXd& dual);
  SolverStatus status() const { return status_; }
  const std::string& message() const { return message_; }

 private:
  using Problem = LocalModel::Problem;

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr int kStepsPerInner = 20;      ///< number of steps per stopInners
  static constexpr int kManyVariables = 100;     ///< problems with more variables steer penalties
  static constexpr int kPassesOfMany = 3;        ///< and limit the passes of the model to this number,
  static constexpr int kPasses = 12;             ///< others to this number
  static constexpr double kMinScale = 1e-4;      ///< least magnitude of the cost for relative decreases
  static constexpr double kMinDecrease = 1e-16;  ///< smaller relative decreases count as none
  static constexpr double kRounding = 1e-10;     ///< share of the Lagrangian that may be a rounding error,
  static constexpr double kMinRounding = 1e-12;  ///< and its least value
  static constexpr double kImproves = .5;  ///< share of the violation, to first order, after a step that improves it
  static constexpr double kNearlyFeasible = .02;  ///< the same for a step to try with new multipliers
  static constexpr double kFair = .3;             ///< ratio of a step that only gradients show to be good
  static constexpr double kPoor = .5;             ///< ratio below which a correction is tried
  static constexpr double kGood = .7;             ///< ratio above which multipliers may be updated at once
  static constexpr double kVeryGood = .75;        ///< ratio above which steps may become longer
  static constexpr double kFastFall = .25;        ///< factor of the error for an immediate update of multipliers
  static constexpr double kNearCorrection = .5;   ///< largest share of a step that its correction may have
  static constexpr double kSteepSlope = .1, kMinSlopeScale = .01;  ///< a tiny step with a larger slope is too short
  static constexpr int kMaxLost = 3;                               ///< number of failures of the damping
  static constexpr int kMaxRestorations = 5;
  static constexpr int kMaxActivations = 40;  ///< number of activations of lazy constraints

  /// A step of the model, with properties of its start.
  struct Step {
    double curvature;                ///< largest curvature of the costs, the scale of damping
    double error;                    ///< constraintError()
    double violation;                ///< of the worst constraint
    double size = 0.;                ///< largest entry of the step
    double predicted = 0.;           ///< decrease of the Lagrangian that the model expects
    bool is_tiny = false;            ///< within the tolerances
    double ratio = 0.;               ///< actual by predicted decrease, after the trial
    double before = 0., after = 0.;  ///< the Lagrangian at both ends, after the trial
  };

  bool solvedInOneStep();
  void iterate();
  bool reachedLimit(int steps);
  Step startStep();
  Problem modelProblem();
  bool costsHaveConverged(const Step& step) const;
  bool needsNoStep(const Step& step, const Problem& problem);
  void findStep(const Problem& problem, Step& step);
  void raisePenalty(Step& step);
  bool triesLessDamping(const Step& step);
  void endAt(const Step& step);
  bool improvesConstraints(const Step& step) const;
  bool roundIsOver(const Step& step) const;
  bool continuesAfterRound(const Problem& problem, Step& step);
  void endRound(const Step& step);
  bool meetsContradiction(const Step& step);
  bool activatesConstraints(bool is_solution);
  bool needsLargerPenalty(const Step& step);
  void updateMultipliers(double step_size);
  bool tryStep(Step& step);
  bool isSpoiltByPenalties();
  bool correctTrial(Step& step);
  double curvatureAlong(const Step& step) const;
  void accept(const Step& step);
  void refuse(const Step& step);
  bool locallyInfeasible();
  bool restored();
  void reduceViolation();

  void stop(SolverStatus status, std::string_view message);
  void converge();
  bool evaluate(EvaluatedPoint& point);

  bool holds(double violation) const { return violation <= tolerance_; }
  void findMultipliers(const VectorXd& c, VectorXd& t) const;
  double squaredMultipliers(const VectorXd& c) const;
  double lagrangian(const EvaluatedPoint& point) const;
  double linearizedViolation() const;
  double squaredViolation(const VectorXd& c) const;
  double gradientNorm(const EvaluatedPoint& point);
  double constraintError() const;
  double steepness();

  void linearize();
  void addCurvature();
  void learnCurvature(const EvaluatedPoint& before);
  void makeBox();

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
  const double tolerance_;  ///< of the constraints
  const bool has_many_variables_;
  const int passes_;  ///< of the minimization of the model

  Penalty penalty_;
  Damping damping_;
  StepRadius radius_;
  InnerTest inner_;
  StagnationTest stagnation_;
  RemainderTest remainder_;
  ViolationTest violation_;
  CorrectionTest correction_;
  int rounds_ = 0,  ///< outer iterations
      penalties_kept_ = 0, restorations_ = 0, times_lost_ = 0, activations_ = 0;
  std::vector<int> activated_;       ///< workspace
  bool model_is_stale_ = true;       ///< the point has changed since
  bool tried_less_damping_ = false;  ///< since the last accepted step
  bool round_just_ended_ = false;    ///< no step was accepted since then
  bool was_corrected_ = false;       ///< whether the trial point is corrected
  bool stopped_ = false;
  SolverStatus status_ = SolverStatus::stalled;
  std::string& message_ = memory_.message;
  std::string not_finite_;    ///< that reason, if the trial point has numbers that are not finite
  std::string_view refusal_;  ///< reason why the last step was refused; empty if accepted
};

}  // namespace kinegraph::inline solvers_internal
