#pragma once

#include "kinegraph/features/feature.h"

namespace kinegraph::inline features_internal {

/// Unit quaternion w x y z of frame A, with dq = E(q) w, E(q) w = (0, w)/2 * q:
///     world              y = q_WA                              E(q_WA) Jw_A
///     difference to B    y = q_WA -+ q_WB, the nearer sign
///     relative to B      y = q_WB^-1 q_WA                      E(y) R_WB^T (Jw_A - Jw_B)
class Orientation final : public Feature {
 public:
  enum class Kind { world, difference, relative };
  Orientation(Kind kind, int a, int b = -1) : kind_(kind), a_(a), b_(b) {}

  int rows() const override { return 4; }
  int quaternionRow() const override { return kind_ == Kind::difference ? -1 : 0; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;
  bool addLaneRows(LaneRowList& list) const override;

 private:
  Kind kind_;
  int a_, b_;
};

/// An axis of frame A as a vector (axis 0 x, 1 y, 2 z):
///     world              y = R_WA e                     w_A x y
///     difference to B    y = R_WA e - R_WB e
///     relative to B      y = R_WB^T R_WA e              R_WB^T ((w_A - w_B) x R_WA e)
class Axis final : public Feature {
 public:
  enum class Kind { world, difference, relative };
  Axis(Kind kind, int axis, int a, int b = -1) : kind_(kind), axis_(axis), a_(a), b_(b) {}

  int rows() const override { return 3; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;
  bool addLaneRows(LaneRowList& list) const override;
  bool hasCurvature(const State& state) const override;
  void addCurvature(const State& state, const VectorXd& weights, Eigen::Ref<MatrixXd> H) const override;

 private:
  Kind kind_;
  int axis_, a_, b_;
};

/// Cosine of the angle between an axis of frame A and one of frame B:  y = u . v,  dy = (w_A - w_B) . (u x v).
class AxisProduct final : public Feature {
 public:
  AxisProduct(int axis_a, int axis_b, int a, int b) : axis_a_(axis_a), axis_b_(axis_b), a_(a), b_(b) {}

  int rows() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;
  bool addLaneRows(LaneRowList& list) const override;
  bool hasCurvature(const State& state) const override;
  void addCurvature(const State& state, const VectorXd& weights, Eigen::Ref<MatrixXd> H) const override;

 private:
  int axis_a_, axis_b_, a_, b_;
};

/// The z axis of frame A minus an axis of frame B:  y = R_WA e_z - R_WB e      3 rows
class AxisDifference final : public Feature {
 public:
  AxisDifference(int a, int b, int axis) : a_(a), b_(b), axis_(axis) {}

  int rows() const override { return 3; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int a_, b_, axis_;
};

/// Returns E(q) with dq = E(q) w, for an angular velocity w in the world.
Eigen::Matrix<double, 4, 3> quaternionRates(const Quaterniond& q);

}  // namespace kinegraph::inline features_internal
