#pragma once

#include "kinegraph/solvers/methods/augmented_lagrangian.h"

namespace kinegraph::inline solvers_internal {

/// Solves a sequence of problems with squared penalties for the constraints. Their weight grows from muInit by muInc
/// until the constraints hold within the tolerance or the weight reaches muMax. `single`: one problem with weight
/// muInit. The method has no multipliers, so `dual` is zero.
SolverResult solveSquaredPenalty(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                                 const EvaluationCallback& callback, bool single);

/// Solves a sequence of problems with barriers -mu log(-phi) for inequalities, whose weight falls from muLBInit by
/// muLBDec. An augmented Lagrangian handles equalities. Throws ValueError if the start does not strictly fulfill all
/// inequalities.
SolverResult solveLogBarrier(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                             const EvaluationCallback& callback);

/// Minimizes the violation of the constraints by Gauss-Newton until they hold, and ignores the costs. The target for
/// inequalities is -interiorPadding.
SolverResult solveSlack(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationCallback& callback);

}  // namespace kinegraph::inline solvers_internal
