#pragma once

#include <array>
#include <vector>

#include "kinegraph/trajectories/scaling_grid.h"

namespace kinegraph::inline trajectories_internal {

/// Bounds the largest ratio of a motion to its limits in an interval with a quadratic s'^2: a polynomial stays within
/// its Bernstein coefficients. Several dofs are bounded at once (SIMD).
class ScalingProof {
 public:
  /// Keeps a reference to `grid`.
  ScalingProof(const ScalingGrid& grid, const MotionLimits& limits);

  /// Returns the ratios of velocity, acceleration and jerk to their limits, for the Bernstein coefficients `b` of s'^2.
  /// The ratio of an unlimited jerk is 0.
  std::array<double, 3> shares(int interval, const std::array<double, 3>& b) const;

 private:
  static constexpr int kLanes = 8;
  static constexpr int kMaxDegree = 3;  ///< of dq/ds
  using Lanes = Eigen::Array<double, kLanes, 1>;
  using Tangent = std::array<Lanes, kMaxDegree + 1>;  ///< Bernstein coefficients of dq/ds

  /// Inverse limits of some dofs; zero without a limit.
  struct Inverse {
    Lanes velocity, acceleration, jerk;
    bool limits_jerk = false;
  };
  double velocityShare(const Tangent& tangent, const std::array<double, 3>& b, double most_speed,
                       const Inverse& inverse) const;
  double accelerationShare(const Tangent& tangent, const std::array<double, 3>& b, const Inverse& inverse) const;
  double jerkShare(const Tangent& tangent, const std::array<double, 3>& b, double most_speed,
                   const Inverse& inverse) const;

  const ScalingGrid& grid_;
  std::vector<Inverse> inverse_;  ///< one per kLanes dofs
};

}  // namespace kinegraph::inline trajectories_internal
