#pragma once

#include "kinegraph/solvers/methods/augmented_lagrangian.h"

namespace kinegraph::inline solvers_internal {

/// First-order methods for problems without constraints. They project to the bounds, converge when the step is below
/// stopTolerance, and throw ValueError for problems with constraints.

/// Minimizes by steps along the gradient, whose length stepInc and stepDec adapt.
SolverResult solveGradientDescent(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                                  const EvaluationCallback& callback = {});

/// Minimizes by Rprop: each variable has its own step, which grows while the sign of its derivative stays and shrinks
/// if it changes. Source: Igel & Huesken, Improving the Rprop learning algorithm, 2000 (iRprop-).
SolverResult solveRprop(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                        const EvaluationCallback& callback = {});

/// Minimizes by limited-memory BFGS with the last ten changes of the gradient, for variables that are not at a bound.
/// Source: Nocedal & Wright, Numerical Optimization, 2nd ed., alg. 7.4, with projection on the bounds.
SolverResult solveLbfgs(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                        const EvaluationCallback& callback = {});

}  // namespace kinegraph::inline solvers_internal
