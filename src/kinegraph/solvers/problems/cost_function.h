#pragma once

#include <string>

#include "kinegraph/solvers/interface/evaluation_hook.h"
#include "kinegraph/solvers/interface/options.h"
#include "kinegraph/solvers/interface/result.h"

namespace kinegraph {

/// A problem without constraints, as one function of x in a box:  F = sum_f phi + sum_sos phi^2 + sum_ineqP max(0,
/// phi)^2. Counts evaluations, asks the hook, keeps the best point. A value that is not finite counts as infinitely
/// bad.
class CostFunction {
 public:
  /// Throws ValueError if the problem has constraints, naming `method` and the first of them, if `x0` does not fit, or
  /// if F or its gradient is not finite there.
  CostFunction(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationHook& hook,
               const char* method, bool with_gradient);

  const VectorXd& start() const { return start_; }  ///< x0, clipped to the bounds
  double startValue() const { return start_value_; }
  const VectorXd& startGradient() const { return start_gradient_; }

  double value(const VectorXd& x) { return evaluate(x, nullptr); }
  double value(const VectorXd& x, VectorXd& gradient) { return evaluate(x, &gradient); }

  VectorXd clip(const VectorXd& x) const { return x.cwiseMax(lower_).cwiseMin(upper_); }
  double width(int i) const { return upper_[i] - lower_[i]; }  ///< of the box; may be infinite

  /// The gradient without the entries whose descent a bound blocks.
  VectorXd freeGradient(const VectorXd& x, const VectorXd& gradient) const;

  /// True if the caller or the limit of evaluations ends it.
  bool ended() const { return cancelled_ || evals_ >= options_.stopEvals; }

  const VectorXd& best() const { return best_x_; }
  double bestValue() const { return best_value_; }

  /// The best point. If ended() the status says so, else it is as given.
  SolverResult result(SolverStatus status, std::string message);

 private:
  double evaluate(const VectorXd& x, VectorXd* gradient);

  Nlp& nlp_;
  const SolverOptions& options_;
  const EvaluationHook& hook_;
  VectorXd lower_, upper_, start_, start_gradient_, phi_, best_x_;
  Jacobian J_;
  double start_value_ = 0., best_value_ = 0.;
  int evals_ = 0;
  bool cancelled_ = false;
  std::string trouble_;
};

}  // namespace kinegraph
