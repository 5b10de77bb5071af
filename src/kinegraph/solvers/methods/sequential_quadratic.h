#pragma once

#include "kinegraph/solvers/methods/augmented_lagrangian.h"

namespace kinegraph {

/// What a problem tells of the curvature of its costs.
enum class CostCurvature {
  squares,  ///< there are no costs of type f: squared residuals tell enough
  unknown,  ///< there are, without a Hessian: it has to be learnt
  known,    ///< their Hessian is told
  large,    ///< there are, but the problem is too large for full matrices, or tells the curvature of its rows, too
};
CostCurvature costCurvature(Nlp& nlp, const VectorXd& x);

/// Minimizes the costs of `nlp` subject to its constraints and bounds, from `x0` (clipped to the bounds), by a sequence
/// of quadratic programs with linearized constraints.
///
/// The Hessian of the Lagrangian is a damped BFGS estimate, beside the Gauss-Newton part of the sos rows. Where the
/// problem tells the Hessian of its f rows, it is that, and only the curvature of the constraints is learnt; it may be
/// indefinite. Steps are cut along a line until an l1 merit function decreases, after one second-order correction of the
/// constraints. With a Hessian, a point is left where an admitted direction with negative curvature leads down, so that
/// `converged` means: the first-order conditions hold, and no such direction was found. Best for smooth problems with
/// general costs, for which Gauss-Newton has no residuals to work with. `dual` (empty, or one multiplier per residual)
/// is where multipliers start if the Hessian is known.
/// Sources: Nocedal & Wright, Numerical Optimization, 2nd ed., ch. 18; Powell, A fast algorithm for nonlinearly
/// constrained optimization calculations, 1978.
SolverResult solveSequentialQuadratic(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                                      const EvaluationHook& hook = {}, const VectorXd& dual = {});

}  // namespace kinegraph
