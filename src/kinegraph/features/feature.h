#pragma once

#include <optional>
#include <span>

#include "kinegraph/kinematics/lane_kinematics.h"
#include "kinegraph/kinematics/state.h"

namespace kinegraph {

/// A differentiable function of configurations: y(q), with J = dy/dq. Evaluating it does not change it, so that threads
/// can share it.
///
/// Most features look at one configuration (order 0); velocities and higher orders of those are backward differences,
/// which `Residual` makes. A feature that defines its own velocity (angularVel) looks at order() + 1 of them.
class Feature {
 public:
  virtual ~Feature() = default;

  virtual int rows() const = 0;

  /// Number of configurations that eval takes, minus one.
  virtual int order() const { return 0; }

  /// Value and Jacobian at `states`, oldest first: order() + 1 of them, `tau` seconds apart. `y` has rows() entries.
  /// `J`, where given, has rows() rows and a block of columns per state, in the same order; it comes filled with zeros.
  virtual void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                    JacobianRows* J) const = 0;

  /// First of four rows that are a quaternion, or -1. Its sign carries no meaning, and targets and differences pick the
  /// nearer one.
  virtual int quaternionRow() const { return -1; }

  /// Is the Jacobian the same in all configurations?
  virtual bool isLinear() const { return false; }

  /// Can addCurvature tell the second derivatives? This may depend on the program of the state, not on its joints.
  virtual bool hasCurvature(const State& state) const {
    (void)state;
    return false;
  }

  /// Adds sum_i weights_i d^2 y_i / dq^2 to the lower triangle of H (dofs x dofs), for a feature of order 0 that
  /// hasCurvature. `weights` has rows() entries.
  virtual void addCurvature(const State& state, const VectorXd& weights, Eigen::Ref<MatrixXd> H) const {
    (void)state, (void)weights, (void)H;
  }

  /// The value of a row that tells that its Jacobian is zero there; it has this value nowhere else.
  virtual std::optional<double> flatValue() const { return {}; }

  /// Adds rows() rows to `list` with the same value and Jacobian, so that many configurations are evaluated at once;
  /// false, and nothing added, where the feature is not made of what LaneRows::Block has.
  virtual bool addLaneRows(LaneRowList& list) const {
    (void)list;
    return false;
  }
};

}  // namespace kinegraph
