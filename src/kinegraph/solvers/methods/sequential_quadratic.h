#pragma once

#include "kinegraph/solvers/methods/augmented_lagrangian.h"

namespace kinegraph::inline solvers_internal {

/// Describes the known curvature of the costs of a problem.
enum class CostCurvature {
  squares,  ///< all costs are squares, whose Gauss-Newton Hessian suffices
  unknown,  ///< costs of type f without a Hessian, which must be estimated
  known,    ///< costs of type f with a Hessian
  large,    ///< costs of type f, but too many variables for full matrices, or residuals with known curvature
};
CostCurvature costCurvature(Nlp& nlp, const VectorXd& x);

/// Minimizes the costs of `nlp` subject to its constraints and bounds, from `x0` (clipped to the bounds), by a sequence
/// of quadratic programs with linearized constraints.
///
/// The Hessian of the Lagrangian is a damped BFGS estimate plus the Gauss-Newton Hessian of the sos costs. If the
/// problem knows the Hessian of its f costs, the method uses it and only estimates the curvature of the constraints;
/// the sum may be indefinite. A line search shortens steps until an l1 merit function decreases, after one second-order
/// correction of the constraints. With a known Hessian, the method leaves points with a feasible direction of negative
/// curvature: `converged` then means that the first-order conditions hold and no such direction was found. The method
/// suits smooth problems with general costs, for which Gauss-Newton has no residuals. `dual` (empty, or one multiplier
/// per residual) initializes the multipliers if the Hessian is known.
/// Sources: Nocedal & Wright, Numerical Optimization, 2nd ed., ch. 18; Powell, A fast algorithm for nonlinearly
/// constrained optimization calculations, 1978.
SolverResult solveSequentialQuadratic(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                                      const EvaluationCallback& callback = {}, const VectorXd& dual = {});

}  // namespace kinegraph::inline solvers_internal
