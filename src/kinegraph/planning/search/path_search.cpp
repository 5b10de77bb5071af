#include "kinegraph/planning/search/path_search.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "kinegraph/common/parallel.h"

namespace kinegraph {

namespace {

constexpr long kFirstEffort = 100000;  // of an attempt
constexpr double kGrowth = 1.5;        // from one attempt to the next

/// Efforts of the attempts, which add up to all that may be spent.
std::vector<long> efforts(long all) {
  std::vector<long> list;
  for (double next = double(kFirstEffort); all > 0; next *= kGrowth) {
    list.push_back(std::min(all, long(next)));
    all -= list.back();
  }
  return list;
}

/// Seeds of attempts differ as those of other calls do.
std::uint64_t attemptSeed(std::uint64_t seed, int attempt) {
  return Rng(seed * 0x9E3779B97F4A7C15ull + std::uint64_t(attempt)).bits();
}

/// Attempts of all threads, and the first one that succeeded.
class Attempts {
 public:
  Attempts(const PathQuery& request, std::vector<long> efforts)
      : request_(request), efforts_(std::move(efforts)), results_(efforts_.size()), first_(int(efforts_.size())) {}

  Way run() {
    parallelFor(
        int(efforts_.size()), 1, request_.threads, [&](int worker, int i, int) { attempt(i, worker == 0); },
        [&] { askWatch(); });
    return collect();
  }

 private:
  struct Result {
    bool found = false;
    Way way;
  };

  bool askWatch() {
    try {
      if (request_.cancellation && request_.cancellation()) stopped_ = true;
    } catch (...) {
      stopped_ = true;
      throw;
    }
    return stopped_;
  }

  void attempt(int i, bool asks) {
    if (stopped_ || first_ < i) return;
    std::optional<Steering> own;
    Steering& steering = asks && request_.steering ? *request_.steering : own.emplace(request_.constraints);
    steering.check().forget();
    TreeSearch search(steering, request_.starts, request_.goals,
                      {request_.range, attemptSeed(request_.seed, i), efforts_[std::size_t(i)]});
    Result& result = results_[std::size_t(i)];
    result.found = search.run([&] { return (asks && askWatch()) || stopped_ || first_ < i; });
    Way& way = result.way;
    if (result.found) {
      way.points = search.path();
      way.start = search.start();
      way.goal = search.goal();
      for (int first = first_; i < first && !first_.compare_exchange_weak(first, i);) {
      }
    }
    way.attempts = {{search.samples(), search.evaluations(), search.nodes(false), search.nodes(true)}};
    way.hits = steering.check().hits();
    way.trees = {search.tree(false), search.tree(true)};
  }

  /// All attempts up to the first that succeeded; where it was stopped, those that were made.
  Way collect() {
    Way all;
    all.was_stopped = stopped_;
    for (int i = 0; i < int(results_.size()) && i <= first_; ++i) {
      Way& one = results_[std::size_t(i)].way;
      for (const SearchReport& report : one.attempts) {
        all.evaluations += report.evaluations;
        all.attempts.push_back(report);
      }
      if (results_[std::size_t(i)].found) {
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

  const PathQuery& request_;
  const std::vector<long> efforts_;
  std::vector<Result> results_;
  std::atomic<int> first_;
  std::atomic<bool> stopped_ = false;
};

/// The straight motions, the shortest first.
std::optional<Way> straightWay(const PathQuery& request, Steering& steering) {
  const JointSpace& space = *request.constraints.space;
  std::vector<std::pair<double, std::pair<int, int>>> lines;
  for (int s = 0; s < int(request.starts.size()); ++s)
    for (int g = 0; g < int(request.goals.size()); ++g)
      lines.push_back({space.distance(request.starts[std::size_t(s)], request.goals[std::size_t(g)]), {s, g}});
  std::sort(lines.begin(), lines.end());
  for (const auto& [length, ends] : lines) {
    const VectorXd &start = request.starts[std::size_t(ends.first)], &goal = request.goals[std::size_t(ends.second)];
    if (request.cancellation && request.cancellation()) break;
    if (!steering.isFree(start, goal)) continue;
    Way way;
    way.points = {start, goal};
    way.start = ends.first;
    way.goal = ends.second;
    way.is_line = true;
    return way;
  }
  return std::nullopt;
}

}  // namespace

Way searchPath(const PathQuery& request) {
  request.constraints.space->requireRanges("planMotion");
  long spent = 0;
  if (request.tries_line) {
    std::optional<Steering> own;
    Steering& steering = request.steering ? *request.steering : own.emplace(request.constraints);
    const long before = steering.evaluations();
    std::optional<Way> line = straightWay(request, steering);
    spent = steering.evaluations() - before;
    if (line) {
      line->evaluations = spent;
      return std::move(*line);
    }
  }
  Way way = Attempts(request, efforts(request.evaluations - spent)).run();
  way.evaluations += spent;
  return way;
}

}  // namespace kinegraph
