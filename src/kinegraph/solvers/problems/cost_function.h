#pragma once

#include <string>

#include "kinegraph/solvers/interface/options.h"
#include "kinegraph/solvers/interface/result.h"

namespace kinegraph::inline solvers_internal {

/// A problem without constraints as one function of x within bounds:
///     F = sum_f phi + sum_sos phi^2 + sum_ineqP max(0, phi)^2
/// Counts evaluations, calls the callback, and keeps the best point. Values that are not finite count as infinite.
class CostFunction {
 public:
  /// Throws ValueError if the problem has constraints (with `method` and the first of them), if `x0` has another size,
  /// or if F or its gradient is not finite at x0.
  CostFunction(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationCallback& callback,
               const char* method, bool with_gradient);

  const VectorXd& start() const { return start_; }  ///< x0, clipped to the bounds
  double startValue() const { return start_value_; }
  const VectorXd& startGradient() const { return start_gradient_; }

  double value(const VectorXd& x) { return evaluate(x, nullptr); }
  double value(const VectorXd& x, VectorXd& gradient) { return evaluate(x, &gradient); }

  VectorXd clip(const VectorXd& x) const { return x.cwiseMax(lower_).cwiseMin(upper_); }
  double width(int i) const { return upper_[i] - lower_[i]; }  ///< distance of the bounds; may be infinite

  /// Returns the gradient without entries whose descent direction an active bound blocks.
  VectorXd freeGradient(const VectorXd& x, const VectorXd& gradient) const;

  /// Whether the callback or the limit of evaluations ended the solve.
  bool ended() const { return cancelled_ || evals_ >= options_.stopEvals; }

  const VectorXd& best() const { return best_x_; }
  double bestValue() const { return best_value_; }

  /// Returns the best point. If ended(), the status says why; else it is the given one.
  SolverResult result(SolverStatus status, std::string message);

 private:
  double evaluate(const VectorXd& x, VectorXd* gradient);

  Nlp& nlp_;
  const SolverOptions& options_;
  const EvaluationCallback& callback_;
  VectorXd lower_, upper_, start_, start_gradient_, phi_, best_x_;
  Jacobian J_;
  double start_value_ = 0., best_value_ = 0.;
  int evals_ = 0;
  bool cancelled_ = false;
  std::string trouble_;
};

}  // namespace kinegraph::inline solvers_internal
