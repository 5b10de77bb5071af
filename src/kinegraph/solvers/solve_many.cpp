#include "kinegraph/solvers/solve_many.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/parallel.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

bool isBetter(const SolverResult& a, const SolverResult& b) {
  if (a.done != b.done) return a.done;
  if (a.feasible != b.feasible) return a.feasible;
  return a.feasible ? a.f + a.sos < b.f + b.sos : a.violation < b.violation;
}

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kWatch{20};

}  // namespace

SolveManyResult solveMany(int count, const SolveManyOptions& options, const SolveOne& solve,
                          const std::function<bool(int)>& watch) {
  if (options.threads < 1) throw ValueError(cat("the number of threads is ", options.threads, "; expected at least 1"));
  if (count < 1) throw ValueError("there are no problems to solve");
  SolveManyResult all;
  all.results.resize(std::size_t(count));
  std::atomic<bool> stop = false;
  std::atomic<int> sufficient = count, ended = 0;  // the first feasible one, where one is enough
  Clock::time_point watched = Clock::now();
  const auto ask = [&] {
    watched = Clock::now();
    try {
      if (watch && watch(ended)) stop = true;
    } catch (...) {
      stop = true;  // for those that run
      throw;
    }
  };
  const auto work = [&](int worker, int i, int) {
    if (stop || i > sufficient) return;
    const EvaluationHook hook = [&, worker, i](const VectorXd&, const VectorXd&) {
      if (worker == 0 && watch && Clock::now() - watched >= kWatch) ask();
      return !stop && i <= sufficient;
    };
    try {
      all.results[std::size_t(i)] = solve(worker, i, hook);
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
    all.results[std::size_t(i)] = SolverResult();  // begun or not: threads decide
  all.chosen = int(std::min_element(all.results.begin(), all.results.end(), isBetter) - all.results.begin());
  return all;
}

SolveManyResult solveAll(const std::vector<NlpSolver*>& solvers, const SolveManyOptions& options, std::uint64_t seed,
                         const std::function<bool(int)>& watch) {
  std::set<const void*> known;
  for (std::size_t i = 0; i < solvers.size(); ++i) {
    if (!solvers[i]->problem())
      throw ValueError(cat("problem ", i, ": this solver has no problem; call setProblem first"));
    if (known.insert(solvers[i]).second && known.insert(solvers[i]->problem().get()).second) continue;
    throw ValueError(
        cat("problem ", i, " is there twice; problems that are solved at the same time are different objects"));
  }
  return solveMany(
      int(solvers.size()), options,
      [&](int, int i, const EvaluationHook& hook) {
        Rng rng(seed);
        return solvers[std::size_t(i)]->solve(false, rng, hook);
      },
      watch);
}

}  // namespace kinegraph
