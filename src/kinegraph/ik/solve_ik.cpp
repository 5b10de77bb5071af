#include "kinegraph/ik/solve_ik.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <optional>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/parallel.h"
#include "kinegraph/common/text.h"
#include "kinegraph/ik/ik_lanes.h"
#include "kinegraph/ik/ik_nlp.h"

namespace kinegraph {

namespace {

constexpr int kLargestPart = 64;  // problems that a thread takes at a time

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
                 const IkWatch& watch) {
  return std::move(IkSolver(config, targets, options).solve({targets}, 1, watch)[0]);
}

std::vector<IkResult> solveIkBatch(const Config& config, const std::vector<std::vector<IkTarget>>& problems,
                                   const IkOptions& options, int threads, const IkWatch& watch) {
  if (problems.empty()) return {};
  return IkSolver(config, problems[0], options).solve(problems, threads, watch);
}

IkSolver::IkSolver(const Config& config, const std::vector<IkTarget>& targets, const IkOptions& options) {
  problem_ = std::make_shared<const IkProblem>(config, targets, options);
}

std::vector<IkResult> IkSolver::solve(std::vector<std::vector<IkTarget>> given, int threads,
                                      const IkWatch& watch) const {
  if (threads < 1) throw ValueError(cat("solveIk: threads is ", threads, "; expected at least 1"));
  const auto question = std::make_shared<const IkQuestion>(problem_, std::move(given));
  const std::vector<std::vector<IkTarget>>& problems = question->problems;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const std::vector<IkProblem::Task>& tasks = problem_->tasks;
    if (problems[i].size() != tasks.size())
      throw ValueError(cat("solveIk: problem ", i, " has other frames or kinds of targets than the first one"));
    for (std::size_t t = 0; t < tasks.size(); ++t) tasks[t].requireSame(problems[i][t], i);
  }
  std::vector<IkResult> results(problems.size());
  const int count = int(problems.size());
  const auto answered = [&] {
    for (int i = 0; i < count; ++i) {
      results[std::size_t(i)].question = question;
      results[std::size_t(i)].number = i;
    }
    return std::move(results);
  };
  std::atomic<int> done = 0;
  std::atomic<bool> stop = false;
  const std::function<bool()> stopped = [&] { return stop.load(std::memory_order_relaxed); };
  const std::function<bool()> watching = [&] {  // on the calling thread
    try {
      if (watch && watch(done)) stop = true;
    } catch (...) {
      stop = true;  // for the other threads
      throw;
    }
    return stopped();
  };
  if (threads == 1 || count <= 1) {
    IkLanes(problem_).solve(problems.data(), count, results.data(), done, watching);
    return answered();
  }
  const int part = std::clamp(count / (4 * threads), 1, kLargestPart);
  std::vector<std::optional<IkLanes>> searches(std::size_t(std::min(threads, count)));
  parallelFor(
      count, part, threads,
      [&](int worker, int from, int to) {
        std::optional<IkLanes>& search = searches[std::size_t(worker)];
        if (!search) search.emplace(problem_);
        search->solve(&problems[std::size_t(from)], to - from, &results[std::size_t(from)], done,
                      worker == 0 ? watching : stopped);
      },
      [&] { watching(); });  // after a stop the remaining parts end at once, with the status `cancelled`
  return answered();
}

}  // namespace kinegraph
