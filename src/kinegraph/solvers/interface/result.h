#pragma once

#include <functional>
#include <memory>
#include <string>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// Receives every evaluated point of a solver. The solver ends if it returns false.
using EvaluationCallback = std::function<bool(const VectorXd& x, const VectorXd& phi)>;

/// The reason why a solver stopped.
enum class SolverStatus {
  converged,   ///< step and violation are within their tolerances
  infeasible,  ///< no small step reduces the violation: the constraints contradict each other locally
  stalled,     ///< steps made no progress before convergence, for example at a non-smooth point
  limit,       ///< of evaluations, steps or iterations
  cancelled,   ///< by the caller
};

std::string solverStatusName(SolverStatus status);

/// The result of a solve. Not converging is a status, not an error.
struct SolverResult {
  VectorXd x;             ///< the best point found
  VectorXd dual;          ///< one multiplier per residual, 0 for costs
  int evals = 0;          ///< evaluations of this solve
  int totalEvals = 0;     ///< evaluations of all solves of the solver so far
  double time = 0.;       ///< s
  bool feasible = false;  ///< no constraint (scaled) is violated by more than max(1e-3, 10 tolerances)
  bool done = false;
  double f = 0., sos = 0., ineq = 0., eq = 0.;  ///< sums at x, as sumErrors
  double violation = 0.;                        ///< of the worst constraint
  SolverStatus status = SolverStatus::stalled;
  std::string message;                           ///< the reason why the solver stopped, one line
  std::shared_ptr<const LazyValidity> validity;  ///< check between the sampled points; null if there is none
  std::shared_ptr<Nlp> problem;  ///< the problem of an NlpSolver, for `explain`; null from the functions that solve

  /// Whether the solution is also valid between the points that the constraints sample: a motion is then collision-free
  /// between slices. None for problems without such a check. The first call computes it, and `cancellation` may end it.
  std::optional<bool> free(const CancellationToken& cancellation = {}) const;

  /// Returns the message, and the report of the check if all constraints hold but the solution is invalid.
  std::string summary(const CancellationToken& cancellation = {}) const;

  /// Sets f .. eq, violation, feasible and done from the residuals at x.
  void setSums(const std::vector<ObjectiveType>& types, const VectorXd& phi, double tolerance);

  /// "{ time: .., evals: .., done: 1, feasible: 1, eq: .., ineq: .., sos: .., f: .., x-dim: [7] }"
  std::string str() const;
};

}  // namespace kinegraph
