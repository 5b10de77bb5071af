#pragma once

#include "kinegraph/solvers/methods/augmented_lagrangian.h"

namespace kinegraph {

/// Methods for problems without constraints that need the gradient only. They take bounds by projection, converge when
/// the step is below stopTolerance, and throw ValueError for problems with constraints.

/// Steps along the gradient, their length adapted by stepInc and stepDec.
SolverResult solveGradientDescent(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                                  const EvaluationHook& hook = {});

/// Every variable has a step of its own, which grows while the sign of its derivative stays and shrinks when it
/// changes. Source: Igel & Huesken, Improving the Rprop learning algorithm, 2000 (iRprop-).
SolverResult solveRprop(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationHook& hook = {});

/// Quasi-Newton with the last ten changes of the gradient, on the variables that are not at a bound.
/// Source: Nocedal & Wright, Numerical Optimization, 2nd ed., alg. 7.4, with projection on the bounds.
SolverResult solveLbfgs(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationHook& hook = {});

}  // namespace kinegraph
