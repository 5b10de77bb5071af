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

/// How LgpTool solves, and what it takes for solved.
struct LgpOptions {
  int threads = 1;         ///< that solve side by side: what is found is the same, to the bit
  std::uint64_t seed = 0;  ///< of the starts that are drawn
  SolverOptions solver = {.verbose = 0};
  std::function<bool(const SolverResult&)> accepts = {};           ///< none: SolverResult::feasible
  std::function<std::string(const SolverResult&)> describes = {};  ///< how a solve ended; none: SolverResult::summary
  std::function<void(const std::string& line)> tells = {};         ///< none: lines go to the standard output
  CancellationToken cancellation = {};  ///< asked now and then on the calling thread; may throw to end it

  bool isSolved(const SolverResult& result) const { return accepts ? accepts(result) : result.feasible; }
  std::string describe(const SolverResult& result) const;
  void tell(const std::string& line) const;
};

/// How a problem was solved from several starts.
struct LgpSolve {
  SolverResult result;  ///< of the first start that led to a solution; else of the last one
  bool is_solved = false;
  int solves = 0;  ///< starts that were tried
  long evaluations = 0;
};

/// Tries starts in turn, or side by side, until one leads to a solution; leaves the problem where that ended.
LgpSolve solveFrom(const std::shared_ptr<Komo>& komo, const std::vector<VectorXd>& starts, const LgpOptions& options);

/// The same with other tolerances.
LgpSolve solveFrom(const std::shared_ptr<Komo>& komo, const std::vector<VectorXd>& starts, const LgpOptions& options,
                   const SolverOptions& solver);

/// Solves problems of which each is one, from near where they are, side by side. `take` is called for each, in order.
void solveEach(const std::vector<std::shared_ptr<Komo>>& problems, const LgpOptions& options,
               const std::function<void(int problem, SolverResult result)>& take);

}  // namespace kinegraph
