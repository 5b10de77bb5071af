#pragma once

#include <optional>

#include "kinegraph/solvers/problems/constrained_function.h"

namespace kinegraph {

/// A point that would be the solution if residuals were linear, with the multipliers of the constraints there.
struct QuadraticStep {
  VectorXd x, multipliers;
};

/// Solves the problem with residuals linearized at x (and the Hessian of f terms, if the problem knows it) exactly, as
/// a quadratic program, and checks nothing. None if the problem is too large, not convex or infeasible, has costs of
/// other kinds, or says that it is not quadratic.
std::optional<QuadraticStep> quadraticStep(const ConstrainedFunction& function, const VectorXd& x, const VectorXd& phi,
                                           const Jacobian& J);

/// Do x and the multipliers fulfil the first-order conditions to nearly the precision of the numbers?
bool isSolution(const ConstrainedFunction& function, const VectorXd& x, const VectorXd& phi, const Jacobian& J,
                const VectorXd& multipliers);

}  // namespace kinegraph
