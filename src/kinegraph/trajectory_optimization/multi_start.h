#pragma once

#include <cstdint>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/solve_many.h"

namespace kinegraph {

/// Starting points x for a motion problem: its present path, then random ones, as setRandomPath. The path stays.
/// `cancellation`, where given, is called before each of them, and may throw.
std::vector<VectorXd> sampleStarts(Komo& komo, int count, std::uint64_t seed,
                                   const CancellationToken& cancellation = {});

/// Solves a motion problem from several starting points x, one copy of it per thread. The Komo is left at the chosen
/// solution. Throws ValueError without starts or for starts of a wrong length; `solver` are the options of all.
SolveManyResult solveFromMany(const std::shared_ptr<Komo>& komo, const std::vector<VectorXd>& starts,
                              const SolverOptions& solver = {}, const SolveManyOptions& options = {},
                              const ProgressCallback& progress = {}, const CancellationToken& cancellation = {});

}  // namespace kinegraph
