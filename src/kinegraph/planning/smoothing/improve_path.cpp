#include "kinegraph/planning/smoothing/improve_path.h"

#include <algorithm>

#include "kinegraph/common/parallel.h"
#include "kinegraph/planning/smoothing/rope_shortcut.h"
#include "kinegraph/planning/smoothing/shortcut.h"

namespace kinegraph {

namespace {

constexpr long kTryEffort = 4;  // of a further try, in efforts of the first
constexpr int kCuts = 30;       // random ones

double costOf(const JointSpace& space, const VectorXd& weight, const std::vector<VectorXd>& points) {
  double sum = 0.;
  for (std::size_t i = 1; i < points.size(); ++i)
    sum += space.difference(points[i - 1], points[i]).cwiseProduct(weight).norm();
  return sum;
}

}  // namespace

ShortcutResult improvePath(const Way& first, const PathQuery& request, const ImprovePathOptions& options,
                           SteeringContexts& contexts) {
  std::vector<ShortcutResult> candidates(std::size_t(first.is_line ? 1 : options.tries));
  const auto pull = [&](Steering& steering, ShortcutResult& candidate) {
    std::vector<VectorXd> points =
        tightenPath(steering, candidate.points,
                    {.weight = options.weight, .refinements = options.refinements, .cancellation = options.late});
    const double cost = costOf(*request.constraints.space, options.weight, points);
    if (cost >= candidate.cost) return;
    candidate.points = std::move(points);
    candidate.cost = cost;
  };
  const auto attempt = [&](int worker, int i) {
    const int number = options.first_try + i;
    ShortcutResult& candidate = candidates[std::size_t(i)];
    Steering& steering = contexts.of(worker, request.constraints);
    const long before = steering.evaluations();
    const CancellationToken cancellation = worker == 0 ? request.cancellation : options.late;
    if (number == 0) {
      candidate.way = first;
    } else {
      PathQuery other = request;
      other.seed = Rng(request.seed + std::uint64_t(number)).bits();
      other.evaluations = std::min(request.evaluations, kTryEffort * (first.evaluations + 1000));
      other.threads = 1;
      other.tries_line = false;
      other.cancellation = cancellation;
      other.steering = &steering;
      if (cancellation && cancellation()) return;
      candidate.way = searchPath(other);
      candidate.evaluations = steering.evaluations() - before;
      if (candidate.way.points.empty()) return;
    }
    ShortcutOptions shortening{
        .weight = options.weight, .seed = request.seed + std::uint64_t(number), .cancellation = cancellation};
    if (!steering.isConstrained()) {  // what is pulled taut needs little more than that its postures are joined
      shortening.cuts = kCuts;
      shortening.corners = false;
    }
    candidate.points = shorten(steering, candidate.way.points, shortening);
    candidate.cost = costOf(*request.constraints.space, options.weight, candidate.points);
    if (candidate.cost < options.taut_below) pull(steering, candidate);
    candidate.evaluations = steering.evaluations() - before;
  };
  parallelFor(
      int(candidates.size()), 1, request.threads, [&](int worker, int i, int) { attempt(worker, i); },
      [&] {
        if (request.cancellation) request.cancellation();
      });
  long evaluations = 0;
  for (const ShortcutResult& candidate : candidates) evaluations += candidate.evaluations;
  ShortcutResult best = std::move(*std::ranges::min_element(candidates, {}, &ShortcutResult::cost));
  best.evaluations = evaluations;
  return best;
}

void tighten(ShortcutResult& best, const PathQuery& request, const VectorXd& weight, int refinements,
             SteeringContexts& contexts) {
  Steering& steering = contexts.of(0, request.constraints);
  const long before = steering.evaluations();
  std::vector<VectorXd> points = tightenPath(
      steering, best.points, {.weight = weight, .refinements = refinements, .cancellation = request.cancellation});
  const double cost = costOf(*request.constraints.space, weight, points);
  best.evaluations = steering.evaluations() - before;
  if (cost >= best.cost) return;
  best.points = std::move(points);
  best.cost = cost;
}

}  // namespace kinegraph
