#pragma once

#include <string>
#include <vector>

#include "kinegraph/solvers/methods/augmented_lagrangian.h"

namespace kinegraph {

/// Solves a problem by `options.method`. The header of each method describes the problems that it supports; methods
/// without support for constraints throw ValueError if there are any. OptMethod::Ipopt and NLopt are external packages,
/// which only Python offers. `memory` must belong to this problem.
SolverResult solve(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const VectorXd& dual = {},
                   const EvaluationCallback& callback = {}, AugmentedLagrangianMemory* memory = nullptr);

/// Makes status and feasibility consistent: a feasible result cannot be `infeasible`, and an infeasible one cannot be
/// `converged`. In both cases the status becomes `stalled`.
void agreeOnFeasibility(SolverResult& result);

/// Returns the methods that `solve` supports.
const std::vector<OptMethod>& availableMethods();

}  // namespace kinegraph
