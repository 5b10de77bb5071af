#include "kinegraph/planning/steering/steering.h"

#include <algorithm>

namespace kinegraph::inline planning_internal {

static_assert(SearchSpace<Steering>);

namespace {

constexpr double kStep = .1;         // between configurations on a manifold
constexpr double kLeastStep = 1e-3;  // shorter steps count as no progress

}  // namespace

std::optional<VectorXd> Steering::projected(VectorXd q) {
  if (isConstrained() && !manifold_.project(q)) return std::nullopt;
  return q;
}

std::optional<VectorXd> Steering::sample(Rng& rng, const VectorXd& like) {
  return projected(space().sample(rng, like));
}

std::optional<VectorXd> Steering::sampleNear(Rng& rng, const VectorXd& center, double radius) {
  const VectorXd away = space().difference(center, space().sample(rng, center));
  VectorXd q = center + rng.uniform(0., radius) / std::max(away.norm(), 1e-9) * away;
  space().clamp(q);
  space().normalize(q);
  return projected(std::move(q));
}

bool Steering::isFree(const VectorXd& from, const VectorXd& to) {
  return manifold_.holdsAlong(from, to, kSpacing) && check_.isMotionFree(from, to);
}

Extension Steering::extend(const VectorXd& from, const VectorXd& target, double range) {
  if (isConstrained()) return alongManifold(from, target, range);
  const double distance = space().distance(from, target);
  VectorXd to = target;
  const bool reaches = distance <= range;
  if (!reaches) {
    to = from + range / distance * space().difference(from, target);
    space().normalize(to);
  }
  if (!check_.seemsFree(from, to)) return {};
  return {{to}, reaches};
}

/// Takes short straight steps and projects each back onto the manifold. Stops when a step comes no nearer.
Extension Steering::alongManifold(const VectorXd& from, const VectorXd& target, double range) {
  Extension extension;
  VectorXd q = from;
  double left = space().distance(q, target);
  for (double gone = 0., step = kStep; gone < range && left > 0.;) {
    VectorXd next = target;
    const bool last = left <= step;
    if (!last) {
      next = q + step / left * space().difference(q, target);
      space().normalize(next);
      if (!manifold_.project(next)) return extension;
    }
    const double moved = space().distance(q, next), left_then = space().distance(next, target);
    if (moved < kLeastStep && !last) return extension;
    if (!manifold_.holdsAlong(q, next, kSpacing)) {  // the step is too long for this curvature
      step *= .5;
      if (step < kLeastStep) return extension;
      continue;
    }
    if (moved > 2. * step || (left_then >= left && !last) || !check_.seemsFree(q, next)) return extension;
    extension.points.push_back(next);
    extension.reached = last;
    if (last) return extension;
    q = next;
    left = left_then;
    gone += moved;
  }
  return extension;
}

std::optional<std::vector<VectorXd>> Steering::connect(const VectorXd& from, const VectorXd& to) {
  if (!isConstrained()) {
    if (check_.isMotionFree(from, to)) return std::vector<VectorXd>();
    return std::nullopt;
  }
  Extension extension = alongManifold(from, to, 2. * space().distance(from, to));
  if (!extension.reached) return std::nullopt;
  extension.points.pop_back();
  VectorXd before = from;
  for (const VectorXd& point : extension.points) {
    if (!check_.isMotionFree(before, point)) return std::nullopt;
    before = point;
  }
  if (!check_.isMotionFree(before, to)) return std::nullopt;
  return std::move(extension.points);
}

}  // namespace kinegraph::inline planning_internal
