#pragma once

#include <optional>

#include "kinegraph/solvers/problems/constrained_function.h"

namespace kinegraph::inline solvers_internal {

/// The solution of the problem with linearized residuals, with the multipliers of the constraints.
struct QuadraticStep {
  VectorXd x, multipliers;
};

/// Solves the problem with residuals linearized at x (and the Hessian of f terms, if it is known) exactly, as a
/// quadratic program, without checking the result. None if the problem is too large, not convex or infeasible, has
/// costs of other types, or is known not to be quadratic.
std::optional<QuadraticStep> quadraticStep(const ConstrainedFunction& function, const VectorXd& x, const VectorXd& phi,
                                           const Jacobian& J);

/// Whether x and the multipliers fulfill the first-order conditions up to rounding errors.
bool isSolution(const ConstrainedFunction& function, const VectorXd& x, const VectorXd& phi, const Jacobian& J,
                const VectorXd& multipliers);

}  // namespace kinegraph::inline solvers_internal
