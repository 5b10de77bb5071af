#pragma once

#include "kinegraph/solvers/interface/result.h"

namespace kinegraph {

/// Remembers the best point that a solver has seen, for where it ends without a result: one that meets the constraints
/// before one that does not, then the least cost, or the least violation.
class BestSoFar {
 public:
  /// `tolerance` of the constraints.
  BestSoFar(const Nlp& nlp, double tolerance) : nlp_(nlp), tolerance_(tolerance) {}

  void see(const VectorXd& x, const VectorXd& phi);  ///< without effect where phi is not finite
  bool isKnown() const { return x_.size() > 0; }

  /// With status cancelled, and no multipliers.
  SolverResult result(int evals) const;

 private:
  const Nlp& nlp_;
  double tolerance_, cost_ = 0., violation_ = 0.;
  VectorXd x_, phi_;
};

}  // namespace kinegraph
