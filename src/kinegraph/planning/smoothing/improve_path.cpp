#include "kinegraph/planning/smoothing/improve_path.h"

#include <algorithm>

#include "kinegraph/common/parallel.h"
#include "kinegraph/planning/smoothing/rope_shortcut.h"
#include "kinegraph/planning/smoothing/shortcut.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr long kFurtherBudget = 4;  // of a further search, in evaluations of the first
constexpr int kCuts = 30;           // random shortcuts of a path that is tightened later

double costOf(const JointSpace& space, const VectorXd& weight, const std::vector<VectorXd>& points) {
  double sum = 0.;
  for (std::size_t i = 1; i < points.size(); ++i)
    sum += space.difference(points[i - 1], points[i]).cwiseProduct(weight).norm();
  return sum;
}

}  // namespace

ShortcutResult improvePath(const PathSearchResult& first, const PathQuery& query, const ImprovePathOptions& options,
                           SteeringContexts& contexts) {
  std::vector<ShortcutResult> candidates(std::size_t(first.is_line ? 1 : options.paths));
  const auto tightenCandidate = [&](Steering& steering, ShortcutResult& candidate) {
    std::vector<VectorXd> points =
        tightenPath(steering, candidate.points,
                    {.weight = options.weight, .refinements = options.refinements, .cancellation = options.late});
    const double cost = costOf(*query.constraints.space, options.weight, points);
    if (cost >= candidate.cost) return;
    candidate.points = std::move(points);
    candidate.cost = cost;
  };
  const auto runCandidate = [&](int worker, int i) {
    const int number = options.first_number + i;
    ShortcutResult& candidate = candidates[std::size_t(i)];
    Steering& steering = contexts.of(worker, query.constraints);
    const long before = steering.evaluations();
    const CancellationToken cancellation = worker == 0 ? query.cancellation : options.late;
    if (number == 0) {
      candidate.found = first;
    } else {
      PathQuery other = query;
      other.seed = Rng(query.seed + std::uint64_t(number)).bits();
      other.max_evaluations = std::min(query.max_evaluations, kFurtherBudget * (first.evaluations + 1000));
      other.threads = 1;
      other.tries_line = false;
      other.cancellation = cancellation;
      other.steering = &steering;
      if (cancellation && cancellation()) return;
      candidate.found = searchPath(other);
      candidate.evaluations = steering.evaluations() - before;
      if (candidate.found.points.empty()) return;
    }
    ShortcutOptions shortcut_options{
        .weight = options.weight, .seed = query.seed + std::uint64_t(number), .cancellation = cancellation};
    if (!steering.isConstrained()) {  // tightening does the rest
      shortcut_options.cuts = kCuts;
      shortcut_options.corners = false;
    }
    candidate.points = shortcutPath(steering, candidate.found.points, shortcut_options);
    candidate.cost = costOf(*query.constraints.space, options.weight, candidate.points);
    if (candidate.cost < options.tighten_below) tightenCandidate(steering, candidate);
    candidate.evaluations = steering.evaluations() - before;
  };
  parallelFor(
      int(candidates.size()), 1, query.threads, [&](int worker, int i, int) { runCandidate(worker, i); },
      [&] {
        if (query.cancellation) query.cancellation();
      });
  long evaluations = 0;
  for (const ShortcutResult& candidate : candidates) evaluations += candidate.evaluations;
  ShortcutResult best = std::move(*std::ranges::min_element(candidates, {}, &ShortcutResult::cost));
  best.evaluations = evaluations;
  return best;
}

void tighten(ShortcutResult& best, const PathQuery& query, const VectorXd& weight, int refinements,
             SteeringContexts& contexts) {
  Steering& steering = contexts.of(0, query.constraints);
  const long before = steering.evaluations();
  std::vector<VectorXd> points = tightenPath(
      steering, best.points, {.weight = weight, .refinements = refinements, .cancellation = query.cancellation});
  const double cost = costOf(*query.constraints.space, weight, points);
  best.evaluations = steering.evaluations() - before;
  if (cost >= best.cost) return;
  best.points = std::move(points);
  best.cost = cost;
}

}  // namespace kinegraph::inline planning_internal
