#pragma once

#include <memory>
#include <string>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// Why a solver stopped.
enum class SolverStatus {
  converged,   ///< step and violation are within their tolerances
  infeasible,  ///< no small step reduces the violation: constraints contradict each other, here
  stalled,     ///< steps stopped helping before convergence, as at a kink
  limit,       ///< of evaluations, steps or rounds
  cancelled,   ///< by the caller
};

std::string solverStatusName(SolverStatus status);

/// How a solve ended. Not converging is a status, not an error.
struct SolverResult {
  VectorXd x;             ///< the best point found
  VectorXd dual;          ///< multiplier per residual, 0 for costs
  int evals = 0;          ///< of this solve
  int totalEvals = 0;     ///< of all solves of the solver so far, this one included
  double time = 0.;       ///< s
  bool feasible = false;  ///< no constraint (scaled) is violated by more than max(1e-3, 10 tolerances)
  bool done = false;
  double f = 0., sos = 0., ineq = 0., eq = 0.;  ///< sums at x, as sumErrors
  double violation = 0.;                        ///< of the worst constraint
  SolverStatus status = SolverStatus::stalled;
  std::string message;                         ///< one line: why it stopped
  std::shared_ptr<const LazyValidity> motion;  ///< of what lies between the slices of a path; null: nothing to say
  std::shared_ptr<Nlp> problem;  ///< what NlpSolver solved, for `explain`; null from the functions that solve

  /// Is the motion free of collisions at all times, between the slices of the path, too? None for problems that are no
  /// motions, or do not forbid collisions. Found when first asked for; `cancellation` is called meanwhile, and may throw.
  std::optional<bool> free(const CancellationToken& cancellation = {}) const;

  /// The message; and where the constraints hold but the motion is not free, which shapes meet, when, and how deep.
  std::string summary(const CancellationToken& cancellation = {}) const;

  /// Fills f .. eq, violation, feasible and done from the residuals at x.
  void setSums(const std::vector<ObjectiveType>& types, const VectorXd& phi, double tolerance);

  /// "{ time: .., evals: .., done: 1, feasible: 1, eq: .., ineq: .., sos: .., f: .., x-dim: [7] }"
  std::string str() const;
};

}  // namespace kinegraph
