#pragma once

#include <functional>
#include <vector>

#include "kinegraph/common/progress.h"
#include "kinegraph/solvers/nlp_solver.h"

namespace kinegraph {

struct SolveManyOptions {
  bool best = true;  ///< solves all problems; false: ends with the feasible result of the lowest index
  int threads = 1;
};

/// The results of several problems.
struct SolveManyResult {
  std::vector<SolverResult> results;  ///< per problem; not `done` if an earlier one sufficed
  int chosen = -1;  ///< the best: feasible before infeasible, then the least cost, or the least violation

  /// The chosen result. Throws ValueError if there are none.
  const SolverResult& best() const;
};

/// Solves several problems: calls solve(worker, i, callback) for i = 0 .. count-1 and collects the results.
///
/// Workers 0 .. threads-1 share the problems; worker 0 is the calling thread. `solve` passes `callback` on to a solver.
/// Before each of its problems, every 20 ms and at the end, the calling thread calls `progress` with the number of
/// solved problems and asks `cancellation`. If that is cancelled, running problems are cancelled, and the others stay
/// not `done`, as does a problem whose solve throws EvaluationCancelled. Neither the results nor the choice depend on
/// the number of threads. If several problems throw an Error, that of the lowest index is passed on. Throws ValueError
/// if there are no problems or threads.
using SolveOne = std::function<SolverResult(int worker, int i, const EvaluationCallback& callback)>;
SolveManyResult solveMany(int count, const SolveManyOptions& options, const SolveOne& solve,
                          const ProgressCallback& progress = {}, const CancellationToken& cancellation = {});

/// Solves independent problems, each from the x of its solver or, if there is none yet, from the initial point of a
/// generator with this seed. Throws ValueError if a solver or a problem occurs twice.
SolveManyResult solveAll(const std::vector<NlpSolver*>& solvers, const SolveManyOptions& options = {},
                         std::uint64_t seed = 0, const ProgressCallback& progress = {},
                         const CancellationToken& cancellation = {});

}  // namespace kinegraph
