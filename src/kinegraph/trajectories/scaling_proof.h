#pragma once

#include <array>
#include <vector>

#include "kinegraph/trajectories/scaling_grid.h"

namespace kinegraph {

/// How much of its limits a motion uses at most in an interval of a grid where s'^2 is a quadratic of s. Bounds:
/// polynomials keep within their Bernstein coefficients. Several dofs are looked at side by side.
class ScalingProof {
 public:
  /// `grid` must stay.
  ScalingProof(const ScalingGrid& grid, const MotionLimits& limits);

  /// Of velocity, acceleration and jerk, each as a share, for the Bernstein coefficients `b` of s'^2. Jerks are looked at
  /// where they are limited.
  std::array<double, 3> shares(int interval, const std::array<double, 3>& b) const;

 private:
  static constexpr int kLanes = 8;
  static constexpr int kMostDegree = 3;  ///< of dq/ds
  using Lanes = Eigen::Array<double, kLanes, 1>;
  using Tangent = std::array<Lanes, kMostDegree + 1>;  ///< Bernstein coefficients of dq/ds

  /// One over the limits of some dofs; zero for what is not limited.
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
  std::vector<Inverse> inverse_;  ///< of kLanes dofs each
};

}  // namespace kinegraph
