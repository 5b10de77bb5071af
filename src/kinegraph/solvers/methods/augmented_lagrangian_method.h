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

/// What solutions of a problem hand on to the next. It stays below the 1032 bytes up to which glibc keeps freed memory at
/// hand: above, solving a small problem that is made anew takes 3 % more instructions.
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
  double penalty = 0.;  ///< at its end
  std::string message;  ///< why it ended
};

/// The method of solveAugmentedLagrangian, on its way. Where Nocedal & Wright, ch. 17.4, write h, f and L, there are
/// `c` (constraints, equalities first), `cost` and `lagrangian`; lambda and mu are theirs.
class AugmentedLagrangian {
 public:
  using Memory = AugmentedLagrangianMemory::Parts;

  AugmentedLagrangian(Nlp& nlp, Memory& memory, const VectorXd& x0, const SolverOptions& options);

  SolverResult run(const VectorXd& dual);

  /// The same without a result: where it ended is in the memory, as `here` and `lambda`.
  void search(const VectorXd& dual);
  SolverStatus status() const { return status_; }
  const std::string& message() const { return message_; }

 private:
  using Problem = LocalModel::Problem;

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr int kStepsPerInner = 20;        ///< steps that are allowed for each of stopInners
  static constexpr int kManyVariables = 100;       ///< from here on, penalties are steered, and steps
  static constexpr int kPassesOfMany = 3;          ///< minimize the model in so many passes at most,
  static constexpr int kPasses = 12;               ///< else in so many
  static constexpr double kLeastScale = 1e-4;      ///< least costs that predicted decreases are relative to
  static constexpr double kLeastDecrease = 1e-16;  ///< relative decrease that no step has to predict
  static constexpr double kRounding = 1e-10;       ///< part of the Lagrangian that may be rounding,
  static constexpr double kLeastRounding = 1e-12;  ///< and at least so much
  static constexpr double kHelps = .5;  ///< part of the violation that a step which helps leaves, to first order
  static constexpr double kNearlyFeasible = .02;  ///< the same for one that is worth trying with new multipliers
  static constexpr double kFair = .3;             ///< ratio of a step that only gradients tell to be good
  static constexpr double kPoor = .5;             ///< ratio below which a correction is tried
  static constexpr double kGood = .7;             ///< ratio above which multipliers may be updated at once
  static constexpr double kVeryGood = .75;        ///< ratio above which steps may become longer
  static constexpr double kFastFall = .25;        ///< factor of the error at which multipliers are updated at once
  static constexpr double kNearCorrection = .5;   ///< part of a step that its correction may have
  static constexpr double kSteepSlope = .1, kLeastSlopeScale = .01;  ///< a tiny step that predicts more was kept short
  static constexpr int kMostLost = 3;                                ///< times that damping may be lost
  static constexpr int kMostRestorations = 5;
  static constexpr int kMostRefinements = 40;  ///< times that constraints are taken up

  /// A step of the model, and what is known where it starts.
  struct Step {
    double curvature;                ///< largest of the costs, what damping is compared with
    double error;                    ///< of the constraints, see constraintError
    double violation;                ///< of the worst constraint
    double size = 0.;                ///< largest entry of the step
    double predicted = 0.;           ///< decrease of the Lagrangian that the model expects
    bool is_tiny = false;            ///< no more than the tolerances
    double ratio = 0.;               ///< of the actual and the predicted decrease, once it has been tried
    double before = 0., after = 0.;  ///< the Lagrangian at both ends, once it has been tried
  };

  bool solvedInOneStep();
  void iterate();
  bool reachedLimit(int steps);
  Step startStep();
  Problem modelProblem();
  bool needsNoStep(const Step& step, const Problem& problem);
  void findStep(const Problem& problem, Step& step);
  void raisePenalty(Step& step);
  bool triesLessDamping(const Step& step);
  void endAt(const Step& step);
  bool helps(const Step& step) const;
  bool roundIsOver(const Step& step) const;
  bool goesOnAfterRound(const Problem& problem, Step& step);
  void endRound(const Step& step);
  bool meetsContradiction(const Step& step);
  bool takesUpConstraints(bool is_solution);
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
  const int passes_;  ///< of the model's minimization

  Penalty penalty_;
  Damping damping_;
  StepRadius radius_;
  InnerTest inner_;
  CreepTest creep_;
  ViolationTest violation_;
  CorrectionTest correction_;
  int rounds_ = 0, restorations_ = 0, times_lost_ = 0, refinements_ = 0;
  std::vector<int> filled_rows_;     ///< workspace
  bool model_is_stale_ = true;       ///< the point is new since it was made
  bool tried_less_damping_ = false;  ///< since the last step that was accepted
  bool round_just_ended_ = false;    ///< no step was accepted since
  bool was_corrected_ = false;       ///< the trial point
  bool stopped_ = false;
  SolverStatus status_ = SolverStatus::stalled;
  std::string& message_ = memory_.message;
  std::string trouble_;  ///< why the last step was refused; empty if it was not
};

}  // namespace kinegraph
