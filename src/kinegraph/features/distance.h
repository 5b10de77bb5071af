#pragma once

#include "kinegraph/features/feature.h"
#include "kinegraph/geometry/distance/proximity.h"

namespace kinegraph::inline features_internal {

/// Negative distance of two shapes: y = -(signed gap), positive in penetration; J = -n^T (Jp_A - Jp_B) at the witness
/// points. Frames without a shape count as points.
class NegDistance final : public Feature {
 public:
  NegDistance(int a, int b) : a_(a), b_(b) {}

  int rows() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int a_, b_;
};

/// A value of the witness points of two shapes, in the world. Its Jacobian combines the relative motion of the shapes,
/// by central differences of the distance computation (step 1e-6), and their common motion, in closed form. At changes
/// of the nearest features it is a one-sided derivative.
class Witness final : public Feature {
 public:
  enum class Kind {
    vector,       ///< point_a - point_b on the surfaces, m
    normal,       ///< unit, from B to A
    point_a,      ///< m
    point_b,      ///< m
    core_vector,  ///< core_a - core_b, without radii, m
  };
  Witness(Kind kind, int a, int b) : kind_(kind), a_(a), b_(b) {}

  int rows() const override { return 3; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  Vector3d value(const Proximity& near) const;

  Kind kind_;
  int a_, b_;
};

/// Two fingers on opposite sides of an object, v_i = core witness vector from object to finger i:
///
///     y = v_1 + v_2                                                              3 rows, m
///     central: below it, 0.01 (2 p + n_1 - n_2), p the direction from finger 1 to finger 2, n_i that of v_i    6 rows
class Oppose final : public Feature {
 public:
  Oppose(int finger1, int finger2, int object, bool central)
      : finger1_(finger1),
        finger2_(finger2),
        first_(Witness::Kind::core_vector, finger1, object),
        second_(Witness::Kind::core_vector, finger2, object),
        central_(central) {}

  int rows() const override { return central_ ? 6 : 3; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int finger1_, finger2_;
  Witness first_, second_;
  bool central_;
};

/// Adds factor * d distance / dq to the single row of J, for the nearest points of two frames. Only the dofs between
/// the frames count, since a common motion does not change their distance.
void addDistanceGradient(const State& state, int a, int b, const Proximity& near, double factor, JacobianRows& J);

}  // namespace kinegraph::inline features_internal
