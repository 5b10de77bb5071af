#include "kinegraph/solvers/interface/best_so_far.h"

namespace kinegraph::inline solvers_internal {

void BestSoFar::see(const VectorXd& x, const VectorXd& phi) {
  if (!phi.allFinite()) return;
  const ErrorSums sums = sumErrors(nlp_.types(), phi);
  const double cost = sums.f + sums.sos, violation = largestViolation(nlp_.types(), phi);
  const bool meets = violation <= tolerance_, best_meets = violation_ <= tolerance_;
  const bool better = meets != best_meets ? meets : meets ? cost < cost_ : violation < violation_;
  if (isKnown() && !better) return;
  x_ = x;
  phi_ = phi;
  cost_ = cost;
  violation_ = violation;
}

SolverResult BestSoFar::result(int evals) const {
  SolverResult result;
  result.x = x_;
  result.evals = evals;
  result.setSums(nlp_.types(), phi_, tolerance_);
  result.status = SolverStatus::cancelled;
  result.message = "an evaluation was cancelled; x is the best point before";
  return result;
}

}  // namespace kinegraph::inline solvers_internal
