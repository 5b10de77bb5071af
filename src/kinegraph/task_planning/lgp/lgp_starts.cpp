#include "kinegraph/task_planning/lgp/lgp_tool.h"

#include "kinegraph/common/log.h"
#include "kinegraph/common/ordered_parallel.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/solvers/nlp_solver.h"

namespace kinegraph {

std::string LgpOptions::describe(const SolverResult& result) const {
  return describes ? describes(result) : result.summary(cancellation);
}

void LgpOptions::printLine(const std::string& line) const {
  if (print)
    print(line);
  else
    logMessage(LogLevel::info, line);
}

namespace {

/// Solves from a guess, or from the initial point of the problem if the guess is empty.
SolverResult solveOnce(const std::shared_ptr<Komo>& komo, const VectorXd& start, const SolverOptions& options,
                       std::uint64_t seed, const CancellationToken& stopped) {
  NlpSolver solver(makeNlp(komo), 0);
  solver.options = options;
  if (start.size() > 0) solver.setInitialization(start);
  Rng rng(seed);
  return solver.solve(false, rng, [&](const VectorXd&, const VectorXd&) { return !stopped(); });
}

}  // namespace

LgpSolve solveFrom(const std::shared_ptr<Komo>& komo, const std::vector<VectorXd>& starts, const LgpOptions& options) {
  return solveFrom(komo, starts, options, options.solver);
}

LgpSolve solveFrom(const std::shared_ptr<Komo>& komo, const std::vector<VectorXd>& starts, const LgpOptions& options,
                   const SolverOptions& solver) {
  const bool is_parallel = options.threads > 1;
  std::vector<std::shared_ptr<Komo>> each(starts.size(), komo);
  if (is_parallel)
    for (auto& one : each) one = std::make_shared<Komo>(komo->clone());
  std::vector<SolverResult> results(starts.size());
  LgpSolve solve;
  orderedParallelFor(
      int(starts.size()), options.threads,
      [&](int i, const CancellationToken& stopped) {
        results[std::size_t(i)] =
            solveOnce(each[std::size_t(i)], starts[std::size_t(i)], solver, options.seed, stopped);
      },
      [&](int i) {
        solve.result = std::move(results[std::size_t(i)]);
        solve.is_solved = options.isSolved(solve.result);
        solve.evaluations += solve.result.evals;
        ++solve.solves;
        if (is_parallel) komo->path().setVariables(each[std::size_t(i)]->path().variables());
        return !solve.is_solved;
      },
      options.cancellation);
  return solve;
}

void solveEach(const std::vector<std::shared_ptr<Komo>>& problems, const LgpOptions& options,
               const std::function<void(int problem, SolverResult result)>& take) {
  std::vector<SolverResult> results(problems.size());
  orderedParallelFor(
      int(problems.size()), options.threads,
      [&](int i, const CancellationToken& stopped) {
        results[std::size_t(i)] = solveOnce(problems[std::size_t(i)], {}, options.solver, options.seed, stopped);
      },
      [&](int i) {
        take(i, std::move(results[std::size_t(i)]));
        return true;
      },
      options.cancellation);
}

}  // namespace kinegraph
