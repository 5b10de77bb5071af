#pragma once

#include <cstdint>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/solve_many.h"

namespace kinegraph {

/// Returns starting points x for a trajectory optimization problem: its present path, then random ones as from
/// setRandomPath. Restores the path. `cancellation` is polled before each sample, and may throw.
std::vector<VectorXd> sampleStarts(Komo& komo, int count, std::uint64_t seed,
                                   const CancellationToken& cancellation = {});

/// Solves a trajectory optimization problem from several starting points x, with one copy of it per thread. Leaves the
/// Komo at the best solution. `solver` are the options of all runs. Throws ValueError without starts, and for starts of
/// a wrong length.
SolveManyResult solveFromMany(const std::shared_ptr<Komo>& komo, const std::vector<VectorXd>& starts,
                              const SolverOptions& solver = {}, const SolveManyOptions& options = {},
                              const ProgressCallback& progress = {}, const CancellationToken& cancellation = {});

}  // namespace kinegraph
