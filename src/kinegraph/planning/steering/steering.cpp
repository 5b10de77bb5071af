#include "kinegraph/planning/steering/steering.h"

namespace kinegraph {

namespace {

constexpr double kStep = .1;     // between postures on a manifold
constexpr double kLeast = 1e-3;  // a step shorter than this gets nowhere

}  // namespace

bool Steering::isFree(const VectorXd& from, const VectorXd& to) {
  return manifold_.holdsAlong(from, to, kSpacing) && check_.isMotionFree(from, to);
}

Steering::Way Steering::towards(const VectorXd& from, const VectorXd& target, double range) {
  if (isConstrained()) return onManifold(from, target, range);
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

/// Short straight steps, each of which is brought back to the manifold. It ends where that brings it no nearer.
Steering::Way Steering::onManifold(const VectorXd& from, const VectorXd& target, double range) {
  Way way;
  VectorXd q = from;
  double left = space().distance(q, target);
  for (double gone = 0., step = kStep; gone < range && left > 0.;) {
    VectorXd next = target;
    const bool last = left <= step;
    if (!last) {
      next = q + step / left * space().difference(q, target);
      space().normalize(next);
      if (!manifold_.project(next)) return way;
    }
    const double moved = space().distance(q, next), left_then = space().distance(next, target);
    if (moved < kLeast && !last) return way;
    if (!manifold_.holdsAlong(q, next, kSpacing)) {  // too long a step for this curvature
      step *= .5;
      if (step < kLeast) return way;
      continue;
    }
    if (moved > 2. * step || (left_then >= left && !last) || !check_.seemsFree(q, next)) return way;
    way.points.push_back(next);
    way.reached = last;
    if (last) return way;
    q = next;
    left = left_then;
    gone += moved;
  }
  return way;
}

std::optional<std::vector<VectorXd>> Steering::between(const VectorXd& from, const VectorXd& to) {
  if (!isConstrained()) {
    if (check_.isMotionFree(from, to)) return std::vector<VectorXd>();
    return std::nullopt;
  }
  Way way = onManifold(from, to, 2. * space().distance(from, to));
  if (!way.reached) return std::nullopt;
  way.points.pop_back();
  VectorXd before = from;
  for (const VectorXd& point : way.points) {
    if (!check_.isMotionFree(before, point)) return std::nullopt;
    before = point;
  }
  if (!check_.isMotionFree(before, to)) return std::nullopt;
  return std::move(way.points);
}

}  // namespace kinegraph
