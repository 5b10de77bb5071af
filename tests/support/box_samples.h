#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kinegraph/common/text.h"
#include "kinegraph/geometry/distance/closed_form/box_distance.h"
#include "tests/support/geometry_samples.h"

namespace kinegraph::testing {

constexpr double kRounding = 1e-12;
constexpr double kIllConditioned = 1e-8;  ///< of the depth of nearly parallel edges
constexpr double kNearlyParallel = 1e-5;  ///< slack of points while directions count as parallel

struct BoxPairSample {
  BoxCore a, b;
  std::string what;  ///< printed if a law fails
};

/// The farthest reach of a box along a direction, m.
inline double supportOf(const BoxCore& box, const Vector3d& direction) {
  return direction.dot(box.X_WB.p) + (box.X_WB.R.transpose() * direction).cwiseAbs().dot(box.half);
}

/// How far a point is outside a box; 0 inside.
inline double distanceOutside(const BoxCore& box, const Vector3d& point) {
  const Vector3d local = box.X_WB.inverse() * point;
  return (local - local.cwiseMax(-box.half).cwiseMin(box.half)).norm();
}

/// Pairs at every distance, overlapping to far apart, many of them parallel, nearly parallel, turned by right
/// angles or flat; the first box moves in the frame of the second, and both are then moved together.
inline std::vector<BoxPairSample> boxPairs(int count, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<BoxPairSample> samples;
  for (int i = 0; i < count; ++i) {
    const auto side = [&] { return rng.uniform() < .1 ? 0. : rng.uniform(.02, .5); };
    const Vector3d half_a(side(), side(), side()), half_b(side(), side(), side());
    const int kind = i % 5;
    Matrix3d R = randomRotation(rng);
    if (kind > 0) {
      R = axisRotation(int(rng.uniform(0., 3.)), std::floor(rng.uniform(0., 4.)) * 2. * std::atan(1.));
      if (kind > 1)
        R = R *
            axisRotation(int(rng.uniform(0., 3.)), kind == 4 ? std::pow(10., rng.uniform(-12., -4.)) : rng.normal());
      if (kind == 2) R.setIdentity();
    }
    const RigidTransform X_BA{R, randomVector(rng, rng.uniform(.1, .8))}, X_WB = randomTransform(rng, .3);
    samples.push_back({{X_WB * X_BA, half_a}, {X_WB, half_b}, cat("pair ", i, " of seed ", seed, ", kind ", kind)});
  }
  return samples;
}

}  // namespace kinegraph::testing
