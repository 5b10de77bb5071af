#pragma once

#include <span>

#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/solve_many.h"

namespace kinegraph {

/// Solves independent motion problems, each from its present path, and stores each result in its problem; `chosen` is
/// the best. The result does not depend on the number of threads. Throws ValueError without problems or threads.

SolveManyResult solveAll(std::span<Komo> problems, const SolveManyOptions& options = {});

}  // namespace kinegraph
