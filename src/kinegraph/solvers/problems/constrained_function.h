#pragma once

#include <string>
#include <vector>

#include "kinegraph/nlp/lazy_constraints.h"
#include "kinegraph/solvers/interface/options.h"
#include "kinegraph/solvers/interface/result.h"

namespace kinegraph::inline solvers_internal {

/// A point and its values.
struct PointValues {
  VectorXd x, phi;
  double cost = 0.;
  double violation = 0.;  ///< of the worst constraint
};

/// A point with values and derivatives.
struct EvaluatedPoint : PointValues {
  Jacobian J;
  VectorXd c;          ///< phi of the constraints
  bool finite = true;  ///< whether phi and J are
};

/// The view of a problem for constrained methods: costs, constraints c (residuals of type eq, ineq, ineqB) and bounds.
/// Counts evaluations, calls the callback, and keeps the best point.
class ConstrainedFunction {
 public:
  explicit ConstrainedFunction(Nlp& nlp);
  ConstrainedFunction(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationCallback& callback)
      : ConstrainedFunction(nlp) {
    begin(x0, options, callback);
  }

  /// Resets the function and its count of evaluations. `callback` must outlive the solve. Throws ValueError for invalid
  /// options or an `x0` of another size.
  void begin(const VectorXd& x0, const SolverOptions& options, const EvaluationCallback& callback);

  Nlp& nlp() const { return nlp_; }
  const std::vector<ObjectiveType>& types() const { return nlp_.types(); }
  const std::vector<int>& costs() const { return costs_; }              ///< indices of residuals of type f, sos, ineqP
  const std::vector<int>& constraints() const { return constraints_; }  ///< indices of residuals, equalities first
  int equalities() const { return equalities_; }
  bool hasGeneralCosts() const { return has_f_; }   ///< costs of type f
  const VectorXd& lower() const { return lower_; }  ///< infinite without options.boundedNewton
  const VectorXd& upper() const { return upper_; }
  VectorXd clip(const VectorXd& x) const { return x.cwiseMax(lower_).cwiseMin(upper_); }

  /// Returns a point with allocated members.
  EvaluatedPoint makePoint() const;

  /// Computes all values at point.x. False if the callback cancels the solve.
  bool evaluate(EvaluatedPoint& point);
  int evals() const { return evals_; }

  /// Activates lazy constraints that a point violates (see LazyConstraints::activate). If there are any, this point
  /// becomes the best one, since the others were evaluated without these constraints.
  Refinement activateConstraints(EvaluatedPoint& point, bool is_solution, std::vector<int>& activated);
  bool activatesAtEachStep() const { return lazy_ && lazy_->activatesAtEachStep(); }

  /// Throws ValueError, naming the residual, if numbers are not finite.
  void requireFiniteStart(const EvaluatedPoint& point) const;

  double cost(const VectorXd& phi) const;
  void costGradient(const VectorXd& phi, const Jacobian& J, VectorXd& gradient) const;

  /// Computes the gradient of the f costs and of the constraints times `multipliers` (empty: zero): the terms of the
  /// Lagrangian without a Gauss-Newton Hessian.
  void generalGradient(const Jacobian& J, const VectorXd& multipliers, VectorXd& gradient) const;
  void addConstraintGradient(const Jacobian& J, const VectorXd& multipliers, VectorXd& gradient) const;

  /// Moves the problem to a point that was evaluated before.
  void moveTo(const PointValues& point);

  /// Keeps the point if it is the best so far: the one of least cost among those within the tolerance, else the one of
  /// least violation.
  void remember(const PointValues& point);
  void forceBest(const PointValues& point);
  const PointValues& best() const { return best_; }

  /// Returns the result of a solve that ended at a point, and leaves the problem there. `multipliers` belong to the
  /// constraints.
  SolverResult result(const PointValues& point, const VectorXd& multipliers, SolverStatus status, std::string message);

 private:
  void summarize(EvaluatedPoint& point) const;

  Nlp& nlp_;
  LazyConstraints* lazy_;  ///< of the problem; may be null
  const EvaluationCallback* callback_ = nullptr;
  double tolerance_ = 0.;
  std::vector<int> costs_, constraints_;
  int equalities_ = 0, evals_ = 0;
  bool has_f_ = false, has_best_ = false;
  bool only_squares_ = true;  ///< whether all costs are of type sos
  VectorXd lower_, upper_, last_x_, moved_phi_;
  PointValues best_;
};

}  // namespace kinegraph::inline solvers_internal
