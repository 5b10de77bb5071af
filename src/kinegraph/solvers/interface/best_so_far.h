#pragma once

#include "kinegraph/solvers/interface/result.h"

namespace kinegraph::inline solvers_internal {

/// Keeps the best point of a solver, as the result of a solve that an exception ends: feasible points before infeasible
/// ones, then the least cost, or the least violation.
class BestSoFar {
 public:
  /// `tolerance` of the constraints.
  BestSoFar(const Nlp& nlp, double tolerance) : nlp_(nlp), tolerance_(tolerance) {}

  void see(const VectorXd& x, const VectorXd& phi);  ///< no effect unless phi is finite
  bool isKnown() const { return x_.size() > 0; }

  /// Returns a result with status cancelled and without multipliers.
  SolverResult result(int evals) const;

 private:
  const Nlp& nlp_;
  double tolerance_, cost_ = 0., violation_ = 0.;
  VectorXd x_, phi_;
};

}  // namespace kinegraph::inline solvers_internal
