#pragma once

#include <optional>
#include <span>

#include "kinegraph/kinematics/lane_kinematics.h"
#include "kinegraph/kinematics/state.h"

namespace kinegraph::inline features_internal {

/// A differentiable function y(q) of configurations, with J = dy/dq. Evaluation is const, so threads may share a
/// feature.
///
/// Most features depend on one configuration (order 0). Their velocities and higher derivatives are backward
/// differences, computed by `Residual`. Features that define their own velocity (angularVel) depend on order() + 1
/// configurations.
class Feature {
 public:
  virtual ~Feature() = default;

  virtual int rows() const = 0;

  /// Returns the number of configurations that eval needs, minus one.
  virtual int order() const { return 0; }

  /// Computes value and Jacobian at `states`, oldest first: order() + 1 of them, `tau` seconds apart. `y` has rows()
  /// entries. `J` may be null; otherwise it has rows() rows and a block of columns per state, in the same order, and
  /// comes filled with zeros.
  virtual void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                    JacobianRows* J) const = 0;

  /// Returns the first of four rows that form a quaternion, or -1. The sign of a quaternion is arbitrary; targets and
  /// differences use the nearer one.
  virtual int quaternionRow() const { return -1; }

  /// Returns true if the Jacobian is the same in all configurations.
  virtual bool isLinear() const { return false; }

  /// Returns true if addCurvature is available. This may depend on the model of the state, but not on its joints.
  virtual bool hasCurvature(const State& state) const {
    (void)state;
    return false;
  }

  /// Adds sum_i weights_i d^2 y_i / dq^2 to the lower triangle of H (dofs x dofs), for a feature of order 0 that
  /// hasCurvature. `weights` has rows() entries.
  virtual void addCurvature(const State& state, const VectorXd& weights, Eigen::Ref<MatrixXd> H) const {
    (void)state, (void)weights, (void)H;
  }

  /// Returns the value of rows whose Jacobian is zero, if there is such a value. Rows with a nonzero Jacobian never
  /// have it.
  virtual std::optional<double> flatValue() const { return {}; }

  /// Adds rows() rows with the same value and Jacobian to `list`, for the evaluation of many configurations at once.
  /// Returns false, and adds nothing, if LaneRows::Block does not support the feature.
  virtual bool addLaneRows(LaneRowList& list) const {
    (void)list;
    return false;
  }
};

}  // namespace kinegraph::inline features_internal
