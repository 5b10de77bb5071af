// The broad phase of EdgeEngine.

#include <algorithm>

#include "kinegraph/collision/edge_engine.h"
#include "kinegraph/geometry/distance/cell_distance.h"
#include "kinegraph/geometry/distance/cell_field.h"
#include "kinegraph/geometry/distance/grid_field.h"

namespace kinegraph::inline collision_internal {

/// Collects the pairs of groups within the margin whose bodies may be closer than `most` in a sample. Returns early
/// with a pair whose inner balls are closer than `near` in a sample.
const EdgeEngine::Candidate* EdgeEngine::findCandidates(double margin, double most, double near) {
  candidates_.clear();
  const std::vector<std::int64_t>* near_fixed = nullptr;
  int near_group = -1;
  for (const LinkBodies::Block& block : bodies_.blocks) {
    if (!bodies_.fixed(block.b)) {
      if (!samples_.mayBeNear(block.a, block.b, margin)) continue;
    } else {
      if (near_group != block.a) near_fixed = &samples_.nearFixed(near_group = block.a, margin);
      if (!(*near_fixed)[std::size_t(block.b - bodies_.moving)]) continue;
    }
    for (int i = block.first; i < block.last; ++i) {
      if (addPair(bodies_.pairs[std::size_t(i)], i, most, near)) return &candidates_.back();
    }
  }
  if (bodies_.many && addNearFixed(margin, most, near)) return &candidates_.back();
  const auto key = [&](const Candidate& c) { return c.index >= 0 && c.index == suspect_ ? -1e300 : c.least; };
  std::sort(candidates_.begin(), candidates_.end(), [&](const Candidate& x, const Candidate& y) {
    const double a = key(x), b = key(y);
    return a < b || (a == b && (x.pair.a < y.pair.a || (x.pair.a == y.pair.a && x.pair.b < y.pair.b)));
  });
  return nullptr;
}

/// Returns true if the inner balls of the pair are closer than `near` in a sample.
bool EdgeEngine::addPair(const LinkBodies::Pair& pair, int index, double most, double near) {
  const auto [least, top] = samples_.distanceBounds(pair.a, pair.b, most);
  Candidate candidate = {pair, index, least, least.head(samples_.count()).minCoeff()};
  if (!pair.convex && candidate.least < most) boundCells(candidate);
  const bool is_near = top.head(samples_.count()).minCoeff(&candidate.touching) < near;
  if (is_near || candidate.least < most) candidates_.push_back(candidate);
  return is_near;
}

/// Raises the bounds of a convex body near solid cells by those of its bounding sphere in the field of the cells.
void EdgeEngine::boundCells(Candidate& candidate) {
  const LinkBodies::Pair& pair = candidate.pair;
  const CollisionBody &a = *bodies_.bodies[std::size_t(pair.a)].shape, &b = *bodies_.bodies[std::size_t(pair.b)].shape;
  candidate.cells = (a.convex() && hasCells(b)) || (b.convex() && hasCells(a));
  if (!candidate.cells) return;
  const bool second = hasCells(b);
  const CollisionBody &convex = second ? a : b, &cells = second ? b : a;
  for (int i = 0; i < samples_.count(); ++i) {
    const RigidTransform X_A = samples_.pose(second ? pair.a : pair.b, i),
                         X_B = samples_.pose(second ? pair.b : pair.a, i);
    const double least = cells.grid().cells->leastDistance(X_B.inverse() * (X_A * convex.boundCenter()));
    candidate.bounds[i] = std::max(candidate.bounds[i], least - convex.boundRadius());
  }
  candidate.least = candidate.bounds.head(samples_.count()).minCoeff();
}

/// For many static bodies: adds those close to moving groups.
bool EdgeEngine::addNearFixed(double margin, double most, double near) {
  for (int g = 0; g < bodies_.moving; ++g) {
    const PlacedSamples::Sphere& sphere = samples_.sphere(g);
    const Vector3d low = sphere.center.array() - sphere.radius, high = sphere.center.array() + sphere.radius;
    near_fixed_.clear();
    bodies_.fixed_tree.forMeeting({low, high}, std::max(margin, 0.) + 1e-9, [&](int item) {
      const int other = bodies_.moving + item;
      if (samples_.mayBeNear(g, other, margin)) bodies_.appendPairs(g, other, near_fixed_);
    });
    for (const LinkBodies::Pair& pair : near_fixed_) {
      if (addPair(pair, -1, most, near)) return true;
    }
  }
  return false;
}

}  // namespace kinegraph::inline collision_internal
