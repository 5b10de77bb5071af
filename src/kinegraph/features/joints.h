#pragma once

#include <vector>

#include "kinegraph/features/feature.h"

namespace kinegraph::inline features_internal {

/// The dofs with the given indices: y = q_i (rad, m).
class JointState final : public Feature {
 public:
  explicit JointState(std::vector<int> dofs) : dofs_(std::move(dofs)) {}

  int rows() const override { return int(dofs_.size()); }
  bool isLinear() const override { return true; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;
  bool addLaneRows(LaneRowList& list) const override;

 private:
  std::vector<int> dofs_;
};

/// Two rows per limited dof: y = (lower - q, q - upper). All <= 0 inside the limits.
class JointLimits final : public Feature {
 public:
  JointLimits(const std::vector<int>& dofs, const KinematicModel& model);

  int rows() const override { return 2 * int(limited_.size()); }
  bool isLinear() const override { return true; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;
  bool addLaneRows(LaneRowList& list) const override;

 private:
  struct Limited {
    int dof;
    double lower, upper;
  };
  std::vector<Limited> limited_;
};

/// One row per group of dofs that form a quaternion (or a point on the circle): y = |q_group|^2 - 1.
class QuaternionNorms final : public Feature {
 public:
  explicit QuaternionNorms(std::vector<KinematicModel::DofRange> groups) : groups_(std::move(groups)) {}

  int rows() const override { return int(groups_.size()); }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  std::vector<KinematicModel::DofRange> groups_;
};

}  // namespace kinegraph::inline features_internal
