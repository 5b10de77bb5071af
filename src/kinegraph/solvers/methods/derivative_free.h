#pragma once

#include "kinegraph/solvers/methods/augmented_lagrangian.h"

namespace kinegraph {

/// Methods for problems without constraints that need values only, as for functions with noise, steps or many minima.
/// They take bounds by projection and throw ValueError for problems with constraints.

/// A simplex that is reflected, stretched and shrunk; n below about 20.
/// Source: Gao & Han, Implementing the Nelder-Mead simplex algorithm with adaptive parameters, 2012.
SolverResult solveNelderMead(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                             const EvaluationHook& hook = {});

/// A population drawn from a normal distribution whose mean and covariance follow its better half. Always draws the
/// same. Source: Hansen, The CMA evolution strategy: a tutorial, 2016.
SolverResult solveCma(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationHook& hook = {});

}  // namespace kinegraph
