#pragma once

#include "kinegraph/solvers/methods/augmented_lagrangian.h"

namespace kinegraph {

/// True for problems of which the curvature has to be learnt: they have costs of type f and offer no Hessian of them,
/// and are small enough for a full matrix.
bool needsLearntCurvature(Nlp& nlp, const VectorXd& x);

/// Minimizes the costs of `nlp` subject to its constraints and bounds, from `x0` (clipped to the bounds), by a sequence
/// of quadratic programs with linearized constraints.
///
/// The Hessian of the Lagrangian is a damped BFGS estimate, beside the Gauss-Newton part of the sos rows. Steps are cut
/// along a line until an l1 merit function decreases, after one second-order correction of the constraints. Best for
/// smooth problems with general costs, for which Gauss-Newton has no residuals to work with.
/// Sources: Nocedal & Wright, Numerical Optimization, 2nd ed., ch. 18; Powell, A fast algorithm for nonlinearly
/// constrained optimization calculations, 1978.
SolverResult solveSequentialQuadratic(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                                      const EvaluationHook& hook = {});

}  // namespace kinegraph
