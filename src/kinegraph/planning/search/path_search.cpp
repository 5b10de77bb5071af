#include "kinegraph/planning/search/path_search.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <optional>

#include "kinegraph/common/parallel.h"
#include "kinegraph/rrt/rrt_connect.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr long kFirstEvaluations = 100000;  // of the first tree search
constexpr long kFirstSamples = 2500;        // likewise, if samples count
constexpr double kGrowth = 1.5;             // of the budget, from one search to the next

/// The budget of one tree search.
struct SearchBudget {
  long evaluations = std::numeric_limits<long>::max(), samples = std::numeric_limits<long>::max();
};

/// Budgets of the searches, which add up to that of the query.
std::vector<SearchBudget> searchBudgets(const PathQuery& query, long spent) {
  const bool by_samples = query.max_samples > 0;
  std::vector<SearchBudget> budgets;
  long all = by_samples ? query.max_samples : query.max_evaluations - spent;
  for (double next = double(by_samples ? kFirstSamples : kFirstEvaluations); all > 0; next *= kGrowth) {
    const long budget = std::min(all, long(next));
    (by_samples ? budgets.emplace_back().samples : budgets.emplace_back().evaluations) = budget;
    all -= budget;
  }
  return budgets;
}

std::uint64_t seedOfSearch(std::uint64_t seed, int search) {
  return Rng(seed * 0x9E3779B97F4A7C15ull + std::uint64_t(search)).bits();
}

/// Runs the tree searches on all threads until the first one that succeeds.
class RestartedSearch {
 public:
  RestartedSearch(const PathQuery& query, std::vector<SearchBudget> budgets)
      : query_(query), budgets_(std::move(budgets)), results_(budgets_.size()), first_(int(budgets_.size())) {}

  PathSearchResult run() {
    parallelFor(
        int(budgets_.size()), 1, query_.threads, [&](int worker, int i, int) { search(i, worker == 0); },
        [&] { isCancelled(); });
    return collect();
  }

 private:
  bool isCancelled() {
    try {
      if (query_.cancellation && query_.cancellation()) stopped_ = true;
    } catch (...) {
      stopped_ = true;
      throw;
    }
    return stopped_;
  }

  void search(int i, bool on_calling_thread) {
    if (stopped_ || first_ < i) return;
    std::optional<Steering> own;
    Steering& steering = on_calling_thread && query_.steering ? *query_.steering : own.emplace(query_.constraints);
    steering.check().forget();
    RrtConnectOptions options;
    options.range = query_.range;
    options.seed = seedOfSearch(query_.seed, i);
    options.max_evaluations = budgets_[std::size_t(i)].evaluations;
    options.max_samples = budgets_[std::size_t(i)].samples;
    RrtConnect trees(steering, query_.starts, query_.goals, options);
    const bool found = trees.run([&] { return (on_calling_thread && isCancelled()) || stopped_ || first_ < i; });
    PathSearchResult& result = results_[std::size_t(i)];
    if (found) {
      result.points = trees.path();
      result.start = trees.start();
      result.goal = trees.goal();
      for (int first = first_; i < first && !first_.compare_exchange_weak(first, i);) {
      }
    }
    result.searches = {{trees.samples(), trees.evaluations(), trees.tree(false).size(), trees.tree(true).size()}};
    result.hits = steering.check().hits();
    result.trees = {trees.tree(false), trees.tree(true)};
  }

  /// Merges the searches up to the first that succeeded, or those that ran before a cancellation.
  PathSearchResult collect() {
    PathSearchResult all;
    all.was_stopped = stopped_;
    for (int i = 0; i < int(results_.size()) && i <= first_; ++i) {
      PathSearchResult& one = results_[std::size_t(i)];
      for (const SearchReport& report : one.searches) {
        all.evaluations += report.evaluations;
        all.searches.push_back(report);
      }
      if (!one.points.empty()) {
        all.points = std::move(one.points);
        all.start = one.start;
        all.goal = one.goal;
        all.was_stopped = false;
      }
      for (const auto& [pair, times] : one.hits) all.hits[pair] += times;
      if (!one.trees.empty()) all.trees = std::move(one.trees);
    }
    return all;
  }

  const PathQuery& query_;
  const std::vector<SearchBudget> budgets_;
  std::vector<PathSearchResult> results_;
  std::atomic<int> first_;
  std::atomic<bool> stopped_ = false;
};

/// Returns the shortest straight edge that is valid.
std::optional<PathSearchResult> straightPath(const PathQuery& query, Steering& steering) {
  const JointSpace& space = *query.constraints.space;
  std::vector<std::pair<double, std::pair<int, int>>> lines;
  for (int s = 0; s < int(query.starts.size()); ++s)
    for (int g = 0; g < int(query.goals.size()); ++g)
      lines.push_back({space.distance(query.starts[std::size_t(s)], query.goals[std::size_t(g)]), {s, g}});
  std::sort(lines.begin(), lines.end());
  for (const auto& [length, ends] : lines) {
    const VectorXd &start = query.starts[std::size_t(ends.first)], &goal = query.goals[std::size_t(ends.second)];
    if (query.cancellation && query.cancellation()) break;
    if (!steering.isFree(start, goal)) continue;
    PathSearchResult result;
    result.points = {start, goal};
    result.start = ends.first;
    result.goal = ends.second;
    result.is_line = true;
    return result;
  }
  return std::nullopt;
}

}  // namespace

PathSearchResult searchPath(const PathQuery& query) {
  query.constraints.space->requireRanges("planMotion");
  long spent = 0;
  if (query.tries_line) {
    std::optional<Steering> own;
    Steering& steering = query.steering ? *query.steering : own.emplace(query.constraints);
    const long before = steering.evaluations();
    std::optional<PathSearchResult> line = straightPath(query, steering);
    spent = steering.evaluations() - before;
    if (line) {
      line->evaluations = spent;
      return std::move(*line);
    }
  }
  PathSearchResult result = RestartedSearch(query, searchBudgets(query, spent)).run();
  result.evaluations += spent;
  return result;
}

}  // namespace kinegraph::inline planning_internal
