#pragma once

#include "kinegraph/solvers/methods/augmented_lagrangian.h"

namespace kinegraph::inline solvers_internal {

/// Derivative-free methods for problems without constraints, for functions with noise, steps or many minima. They
/// project to the bounds and throw ValueError for problems with constraints.

/// Minimizes by the simplex method of Nelder and Mead, for n below about 20.
/// Source: Gao & Han, Implementing the Nelder-Mead simplex algorithm with adaptive parameters, 2012.
SolverResult solveNelderMead(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                             const EvaluationCallback& callback = {});

/// Minimizes by CMA-ES: samples a population from a normal distribution, whose mean and covariance follow the better
/// half of the population. Deterministic. Source: Hansen, The CMA evolution strategy: a tutorial, 2016.
SolverResult solveCma(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                      const EvaluationCallback& callback = {});

}  // namespace kinegraph::inline solvers_internal
