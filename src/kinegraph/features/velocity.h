#pragma once

#include "kinegraph/features/feature.h"

namespace kinegraph::inline features_internal {

/// Angular velocity of a frame between two configurations, in the world (rad/s):
///     y = 2 vec(q_t q_{t-1}^-1) / tau      3 rows; 2 sin(angle/2)/tau along the axis
class AngularVelocity final : public Feature {
 public:
  explicit AngularVelocity(int frame) : frame_(frame) {}

  int rows() const override { return 3; }
  int order() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int frame_;
};

/// Velocity of a frame's origin between two configurations: y = (p_t - p_{t-1}) / tau, 3 rows, m/s.
class LinearVelocity final : public Feature {
 public:
  explicit LinearVelocity(int frame) : frame_(frame) {}

  int rows() const override { return 3; }
  int order() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int frame_;
};

/// Direction of motion of frame B, minus an axis of frame A before the motion:
///
///     y = d / sqrt(|d|^2 + 1e-8) - R_WA(t-1) e,  d = p_B(t) - p_B(t-1)      3 rows
class AlignWithMotion final : public Feature {
 public:
  AlignWithMotion(int axis, int a, int b) : axis_(axis), a_(a), b_(b) {}

  int rows() const override { return 3; }
  int order() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int axis_, a_, b_;
};

}  // namespace kinegraph::inline features_internal
