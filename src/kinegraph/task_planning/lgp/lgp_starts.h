#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/interface/options.h"
#include "kinegraph/solvers/interface/result.h"

namespace kinegraph {

/// Options of LgpTool.
struct LgpOptions {
  int threads = 1;         ///< that solve in parallel; results are bit-identical
  std::uint64_t seed = 0;  ///< of sampled initial guesses
  SolverOptions solver = {.verbose = 0};
  std::function<bool(const SolverResult&)> accepts =
      {};  ///< whether a result is a solution; none: SolverResult::feasible
  std::function<std::string(const SolverResult&)> describes = {};  ///< describes a result; none: SolverResult::summary
  std::function<void(const std::string& line)> print = {};         ///< none: logMessage
  CancellationToken cancellation = {};                             ///< queried on the calling thread; may throw

  bool isSolved(const SolverResult& result) const { return accepts ? accepts(result) : result.feasible; }
  std::string describe(const SolverResult& result) const;
  void printLine(const std::string& line) const;
};

/// The result of solving a problem from several initial guesses.
struct LgpSolve {
  SolverResult result;  ///< of the first guess that led to a solution, else of the last one
  bool is_solved = false;
  int solves = 0;  ///< number of guesses that were tried
  long evaluations = 0;
};

/// Solves from guesses in turn, or in parallel, until one leads to a solution, and leaves the problem there.
LgpSolve solveFrom(const std::shared_ptr<Komo>& komo, const std::vector<VectorXd>& starts, const LgpOptions& options);

/// The same with other solver options.
LgpSolve solveFrom(const std::shared_ptr<Komo>& komo, const std::vector<VectorXd>& starts, const LgpOptions& options,
                   const SolverOptions& solver);

/// Solves independent problems from their current paths, in parallel. `take` is called for each, in order.
void solveEach(const std::vector<std::shared_ptr<Komo>>& problems, const LgpOptions& options,
               const std::function<void(int problem, SolverResult result)>& take);

}  // namespace kinegraph
