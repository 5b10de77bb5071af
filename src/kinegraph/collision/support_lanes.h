#pragma once

// Support functions of convex bodies, one direction per lane. Like lane_math.h, this file is local to each source file
// that includes it.

#include "kinegraph/collision/sample_kernel.h"
#include "kinegraph/math/lane_math.h"

namespace kinegraph::lanes {

namespace {

template <class S>
S along(const Vec3<S>& direction, const double* point) {
  return point[0] * direction.x + point[1] * direction.y + point[2] * direction.z;
}

/// All lanes climb together along neighbors to their farthest corners. The search begins at `corner`, which becomes the
/// corner of the last lane that ends.
template <class S>
S farthestOfNeighbors(const SampleKernel::Convex& body, const Vec3<S>& direction, std::uint32_t& corner) {
  using Mask = decltype(direction.x < direction.x);
  S best = along(direction, body.points + 3 * std::size_t(corner));
  Mask at = Mask{} + std::int64_t(corner), walking = ~Mask{};
  for (;;) {
    for (std::uint32_t k = body.first_neighbor[corner]; k < body.first_neighbor[corner + 1]; ++k) {
      const std::uint32_t neighbor = body.neighbors[k];
      const S height = along(direction, body.points + 3 * std::size_t(neighbor));
      const Mask higher = height > best;
      best = higher ? height : best;
      at = higher ? Mask{} + std::int64_t(neighbor) : at;
    }
    walking &= at != std::int64_t(corner);  // done: higher than all neighbors
    if (!any(walking)) return best;
    for (int i = 0; i < kWidth<S>; ++i) {
      if (walking[i]) corner = std::uint32_t(at[i]);
    }
  }
}

/// The support function of a body's core.
template <class S>
S reachAlong(const SampleKernel::Convex& body, const Vec3<S>& direction, std::uint32_t& corner) {
  if (!body.points) {
    S reach = body.half[0] * magnitude(direction.x) + body.half[1] * magnitude(direction.y) +
              body.half[2] * magnitude(direction.z);
    if (body.is_round) {
      const Vec3<S> scaled = {body.radii[0] * direction.x, body.radii[1] * direction.y, body.radii[2] * direction.z};
      reach = reach + root(dot(scaled, scaled));
    }
    return reach;
  }
  if (body.first_neighbor) return farthestOfNeighbors(body, direction, corner);
  S best = along(direction, body.points);
  for (int i = 1; i < body.count; ++i) best = larger(best, along(direction, body.points + 3 * i));
  return best;
}

}  // namespace

}  // namespace kinegraph::lanes
