#pragma once

#include <functional>
#include <vector>

#include "kinegraph/solvers/nlp_solver.h"

namespace kinegraph {

struct SolveManyOptions {
  bool best = true;  ///< solves all; else the first feasible result ends it, first by index and not by time
  int threads = 1;
};

/// How many problems ended, one result per problem.
struct SolveManyResult {
  std::vector<SolverResult> results;  ///< not `done` where an earlier one sufficed
  int chosen = -1;  ///< the best: feasible before infeasible, then the least cost, or the least violation

  const SolverResult& best() const { return results[std::size_t(chosen)]; }
};

/// Calls solve(worker, i, hook) for i = 0 .. count-1, by workers 0 .. threads-1, the first of which is the calling
/// thread; what it returns is result i. It passes `hook` on to a solver. The calling thread asks `watch` before each of
/// its problems, every 20 ms and at the end, with the number of problems that have ended; once that returns true the
/// problems that run are cancelled, and those that have not begun stay not `done`, as one whose solve throws
/// EvaluationCancelled. Neither the results nor the choice depend on the number of threads. An Error is passed on as
/// that of the first problem that has one. Throws ValueError without problems or threads.
using SolveOne = std::function<SolverResult(int worker, int i, const EvaluationHook& hook)>;
SolveManyResult solveMany(int count, const SolveManyOptions& options, const SolveOne& solve,
                          const std::function<bool(int ended)>& watch = {});

/// Solves independent problems, each from where its solver stands or, if there is no x yet, from the initial point that
/// a generator with this seed gives. Throws ValueError for a solver or a problem that is there twice.
SolveManyResult solveAll(const std::vector<NlpSolver*>& solvers, const SolveManyOptions& options = {},
                         std::uint64_t seed = 0, const std::function<bool(int ended)>& watch = {});

}  // namespace kinegraph
