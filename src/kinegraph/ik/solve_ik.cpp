#include "kinegraph/ik/solve_ik.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/parallel.h"
#include "kinegraph/common/text.h"
#include "kinegraph/ik/ik_lanes.h"

namespace kinegraph {

namespace {

constexpr int kLargestBatch = 64;  // problems that a thread takes at a time

}  // namespace

std::string ikStatusName(IkStatus status) {
  switch (status) {
    case IkStatus::solved:
      return "solved";
    case IkStatus::goal_unreachable:
      return "goal_unreachable";
    case IkStatus::in_collision:
      return "in_collision";
    case IkStatus::cancelled:
      return "cancelled";
  }
  return "unknown";
}

std::string IkResult::str() const {
  if (!feasible()) return cat(ikStatusName(status), ": ", message);
  return cat("solved in ", attempts, attempts == 1 ? " attempt" : " attempts", ", within ", position_error, " m and ",
             rotation_error, " rad", feature_error > 0. ? cat(", features within ", feature_error) : "");
}

IkResult solveIk(const Config& config, const std::vector<IkTarget>& targets, const IkOptions& options,
                 const CancellationToken& cancellation) {
  return std::move(IkSolver(config, targets, options).solve({targets}, 1, {}, cancellation)[0]);
}

std::vector<IkResult> solveIkBatch(const Config& config, const std::vector<std::vector<IkTarget>>& problems,
                                   const IkOptions& options, int threads, const ProgressCallback& progress,
                                   const CancellationToken& cancellation, std::vector<VectorXd> starts) {
  if (problems.empty()) return {};
  return IkSolver(config, problems[0], options).solve(problems, threads, progress, cancellation, std::move(starts));
}

IkSolver::IkSolver(const Config& config, const std::vector<IkTarget>& targets, const IkOptions& options) {
  problem_ = std::make_shared<const IkProblem>(config, targets, options);
}

std::vector<IkResult> IkSolver::solve(std::vector<std::vector<IkTarget>> given, int threads,
                                      const ProgressCallback& progress, const CancellationToken& cancellation,
                                      std::vector<VectorXd> starts) const {
  if (threads < 1) throw ValueError(cat("solveIk: threads is ", threads, "; expected at least 1"));
  if (!starts.empty() && starts.size() != given.size())
    throw ValueError(
        cat("solveIk: there are ", starts.size(), " starts and ", given.size(), " problems; expected equal numbers"));
  for (std::size_t i = 0; i < starts.size(); ++i)
    if (starts[i].size() != problem_->q.size() || !starts[i].allFinite())
      throw ValueError(cat("solveIk: start ", i, " has ", starts[i].size(), " entries; expected ", problem_->q.size(),
                           " finite ones"));
  const auto request = std::make_shared<const IkRequest>(problem_, std::move(given), std::move(starts));
  const auto start_at = [&](int i) { return request->starts.empty() ? nullptr : &request->starts[std::size_t(i)]; };
  const std::vector<std::vector<IkTarget>>& problems = request->problems;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const std::vector<IkProblem::Task>& tasks = problem_->tasks;
    if (problems[i].size() != tasks.size())
      throw ValueError(cat("solveIk: problem ", i, " must have the frames and kinds of targets of problem 0"));
    for (std::size_t t = 0; t < tasks.size(); ++t) tasks[t].requireSame(problems[i][t], i);
  }
  std::vector<IkResult> results(problems.size());
  const int count = int(problems.size());
  const auto withRequest = [&] {
    for (int i = 0; i < count; ++i) {
      results[std::size_t(i)].request = request;
      results[std::size_t(i)].number = i;
    }
    return std::move(results);
  };
  std::atomic<int> done = 0;
  std::atomic<bool> stop = false;
  const CancellationToken stopped = [&] { return stop.load(std::memory_order_relaxed); };
  const CancellationToken asked = [&] {  // on the calling thread
    try {
      if (progress) progress({done, count});
      if (cancellation.isCancelled()) stop = true;
    } catch (...) {
      stop = true;  // also stops the other threads
      throw;
    }
    return stop.load();
  };
  if (threads == 1 || count <= 1) {
    IkLanes(problem_).solve(problems.data(), start_at(0), count, results.data(), done, asked);
    return withRequest();
  }
  const int part = std::clamp(count / (4 * threads), 1, kLargestBatch);
  std::vector<std::optional<IkLanes>> searches(std::size_t(std::min(threads, count)));
  parallelFor(
      count, part, threads,
      [&](int worker, int from, int to) {
        std::optional<IkLanes>& search = searches[std::size_t(worker)];
        if (!search) search.emplace(problem_);
        search->solve(&problems[std::size_t(from)], start_at(from), to - from, &results[std::size_t(from)], done,
                      worker == 0 ? asked : stopped);
      },
      [&] { asked(); });
  return withRequest();
}

}  // namespace kinegraph
