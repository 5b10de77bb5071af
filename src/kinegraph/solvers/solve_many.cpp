#include "kinegraph/solvers/nlp_solver.h"

#include <algorithm>
#include <atomic>
#include <set>

#include "kinegraph/common/cancellation_interval.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/parallel.h"
#include "kinegraph/common/stopwatch.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

bool isBetter(const SolverResult& a, const SolverResult& b) {
  if (a.done != b.done) return a.done;
  if (a.feasible != b.feasible) return a.feasible;
  return a.feasible ? a.f + a.sos < b.f + b.sos : a.violation < b.violation;
}

}  // namespace

const SolverResult& SolveManyResult::best() const {
  if (chosen < 0 || std::size_t(chosen) >= results.size())
    throw ValueError(cat("none of ", results.size(), " results is chosen"));
  return results[std::size_t(chosen)];
}

SolveManyResult solveMany(int count, const SolveManyOptions& options, const SolveOne& solve,
                          const ProgressCallback& progress, const CancellationToken& cancellation) {
  if (options.threads < 1)
    throw ValueError(cat("solveMany: the number of threads is ", options.threads, "; expected at least 1"));
  if (count < 1) throw ValueError("solveMany: there are no problems; expected at least one");
  SolveManyResult all;
  all.results.resize(std::size_t(count));
  std::atomic<bool> stop = false;
  std::atomic<int> sufficient = count, ended = 0;  // index of the first feasible one, if one is enough
  const bool asks = progress || cancellation;
  Stopwatch since_asked;
  const auto ask = [&] {
    since_asked.restart();
    try {
      if (progress) progress({ended, count});
      if (cancellation.isCancelled()) stop = true;
    } catch (...) {
      stop = true;  // cancels running problems
      throw;
    }
  };
  const auto work = [&](int worker, int i, int) {
    if (stop || i > sufficient) return;
    const EvaluationCallback callback = [&, worker, i](const VectorXd&, const VectorXd&) {
      if (worker == 0 && asks && since_asked.seconds() >= std::chrono::duration<double>(kCancellationInterval).count())
        ask();
      return !stop && i <= sufficient;
    };
    try {
      all.results[std::size_t(i)] = solve(worker, i, callback);
    } catch (const EvaluationCancelled&) {
      return;
    } catch (const ValueError& error) {
      throw ValueError(count == 1 ? error.what() : cat("problem ", i, ": ", error.what()));
    }
    ++ended;
    if (options.best || !all.results[std::size_t(i)].feasible) return;
    for (int known = sufficient; i < known && !sufficient.compare_exchange_weak(known, i);) continue;
  };
  parallelFor(count, 1, std::min(options.threads, count), work, ask);
  for (int i = sufficient + 1; i < count; ++i)
    all.results[std::size_t(i)] = SolverResult();  // whether they began depends on the threads
  all.chosen = int(std::min_element(all.results.begin(), all.results.end(), isBetter) - all.results.begin());
  return all;
}

SolveManyResult solveAll(const std::vector<NlpSolver*>& solvers, const SolveManyOptions& options, std::uint64_t seed,
                         const ProgressCallback& progress, const CancellationToken& cancellation) {
  std::set<const void*> known;
  for (std::size_t i = 0; i < solvers.size(); ++i) {
    if (!solvers[i]->problem())
      throw ValueError(cat("problem ", i, ": this solver has no problem; call setProblem first"));
    if (known.insert(solvers[i]).second && known.insert(solvers[i]->problem().get()).second) continue;
    throw ValueError(
        cat("problem ", i, " occurs twice; problems that are solved at the same time must be different objects"));
  }
  return solveMany(
      int(solvers.size()), options,
      [&](int, int i, const EvaluationCallback& callback) {
        Rng rng(seed);
        return solvers[std::size_t(i)]->solve(false, rng, callback);
      },
      progress, cancellation);
}

}  // namespace kinegraph
