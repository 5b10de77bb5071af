#pragma once

#include "kinegraph/solvers/sampling/sampled_problem.h"

namespace kinegraph::inline solvers_internal {

/// Moves a feasible point some steps within the constraints, by options().interiorMethod. The result is feasible.
SampledPoint walkInside(SampledProblem& problem, const SampledPoint& start, int steps, Rng& rng);

}  // namespace kinegraph::inline solvers_internal
