#pragma once

#include <string>
#include <vector>

#include "kinegraph/solvers/methods/augmented_lagrangian.h"

namespace kinegraph {

/// Solves by `options.method`. Each method says in its own header what it takes; one that cannot take constraints
/// throws ValueError where there are some. OptMethod::Ipopt and NLopt are other people's programs, which C++ does not
/// have here. `memory`, where given, is of this problem alone.
SolverResult solve(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const VectorXd& dual = {},
                   const EvaluationHook& hook = {}, AugmentedLagrangianMemory* memory = nullptr);

/// One truth of what is feasible: constraints that hold as `feasible` says do not contradict each other, whatever the
/// method thinks, and with constraints that do not hold nothing has converged. In both cases the status is `stalled`.
void agreeOnFeasibility(SolverResult& result);

/// The methods that `solve` has.
const std::vector<OptMethod>& availableMethods();

}  // namespace kinegraph
