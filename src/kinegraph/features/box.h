#pragma once

#include "kinegraph/features/feature.h"

namespace kinegraph::inline features_internal {

/// Position of an object's origin relative to a box, p = p_BA (m):
///
///     above     4 rows: (x - hx, y - hy, -x - hx, -y - hy), h = half side - rounding; all <= 0 over the box
///     inside    6 rows: (p - h, -p - h), h = half side - 0.01, at least 0.01; all <= 0 inside
class BoxRegion final : public Feature {
 public:
  enum class Kind { above, inside };
  BoxRegion(Kind kind, int object, int box, const Geometry& geometry);

  int rows() const override { return 2 * dims_; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int dims_, object_, box_;
  Vector3d half_;
};

/// Height of an object's center above that of its support, minus the height at which it stands on the support:
///
///     y = z_A - z_B - (height_A + height_B) / 2       1 row, m
class StandingAbove final : public Feature {
 public:
  StandingAbove(int object, int support, double gap) : object_(object), support_(support), gap_(gap) {}

  int rows() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int object_, support_;
  double gap_;
};

}  // namespace kinegraph::inline features_internal
