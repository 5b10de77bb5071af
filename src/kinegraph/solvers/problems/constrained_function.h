#pragma once

#include <string>
#include <vector>

#include "kinegraph/nlp/lazy_constraints.h"
#include "kinegraph/solvers/interface/evaluation_hook.h"
#include "kinegraph/solvers/interface/options.h"
#include "kinegraph/solvers/interface/result.h"

namespace kinegraph {

/// A point and its values.
struct PointValues {
  VectorXd x, phi;
  double cost = 0.;
  double violation = 0.;  ///< of the worst constraint
};

/// A point and all that is known there.
struct EvaluatedPoint : PointValues {
  Jacobian J;
  VectorXd c;          ///< phi of the constraints
  bool finite = true;  ///< are phi and J?
};

/// A problem as methods for constraints see it: costs, constraints c (rows of type eq, ineq, ineqB) and a box.
/// Counts evaluations, asks the hook, keeps the best point.
class ConstrainedFunction {
 public:
  explicit ConstrainedFunction(Nlp& nlp);
  ConstrainedFunction(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationHook& hook)
      : ConstrainedFunction(nlp) {
    begin(x0, options, hook);
  }

  /// Forgets what was evaluated. `hook` must stay. Throws ValueError if the options make no sense or `x0` does not fit.
  void begin(const VectorXd& x0, const SolverOptions& options, const EvaluationHook& hook);

  Nlp& nlp() const { return nlp_; }
  const std::vector<ObjectiveType>& types() const { return nlp_.types(); }
  const std::vector<int>& costs() const { return costs_; }              ///< rows of type f, sos, ineqP
  const std::vector<int>& constraints() const { return constraints_; }  ///< rows, equalities first
  int equalities() const { return equalities_; }
  bool hasGeneralCosts() const { return has_f_; }   ///< of type f
  const VectorXd& lower() const { return lower_; }  ///< infinite if the options say so
  const VectorXd& upper() const { return upper_; }
  VectorXd clip(const VectorXd& x) const { return x.cwiseMax(lower_).cwiseMin(upper_); }

  /// A point with memory for all its parts.
  EvaluatedPoint makePoint() const;

  /// Fills in what is known at point.x. False if the caller wants it to end.
  bool evaluate(EvaluatedPoint& point);
  int evals() const { return evals_; }

  /// Lets the problem take up constraints (LazyConstraints) that are violated at a point. `rows` were empty before;
  /// where there are any, the best point so far is this one, as nothing is known of the others.
  Refinement takeUpConstraints(EvaluatedPoint& point, bool is_solution, std::vector<int>& rows);
  bool takesUpAtEachStep() const { return room_ && room_->isAskedAtEachStep(); }

  /// Throws ValueError, naming the row, if numbers are not finite.
  void requireFiniteStart(const EvaluatedPoint& point) const;

  double cost(const VectorXd& phi) const;
  void costGradient(const VectorXd& phi, const Jacobian& J, VectorXd& gradient) const;

  /// Gradient of the f rows and of the constraints times `multipliers` (empty: zero): what Gauss-Newton has no
  /// curvature of.
  void generalGradient(const Jacobian& J, const VectorXd& multipliers, VectorXd& gradient) const;
  void addConstraintGradient(const Jacobian& J, const VectorXd& multipliers, VectorXd& gradient) const;

  /// Lets the problem stand at a point that was evaluated, though maybe not as the last one.
  void moveTo(const PointValues& point);

  /// Takes the point as the best so far if it is: among those within the tolerance the one of least cost, else of least
  /// violation.
  void remember(const PointValues& point);
  void forceBest(const PointValues& point);
  const PointValues& best() const { return best_; }

  /// How it ended at a point; leaves the problem there. `multipliers` are those of the constraints.
  SolverResult result(const PointValues& point, const VectorXd& multipliers, SolverStatus status, std::string message);

 private:
  void summarize(EvaluatedPoint& point) const;

  Nlp& nlp_;
  LazyConstraints* room_;  ///< the problem, if it is one
  const EvaluationHook* hook_ = nullptr;
  double tolerance_ = 0.;
  std::vector<int> costs_, constraints_;
  int equalities_ = 0, evals_ = 0;
  bool has_f_ = false, has_best_ = false;
  bool only_squares_ = true;  ///< are all costs of type sos?
  VectorXd lower_, upper_, last_x_, moved_phi_;
  PointValues best_;
};

}  // namespace kinegraph
