#pragma once

#include "kinegraph/math/pose.h"

namespace kinegraph::inline control_internal {

/// How far a task is from what steps attain.
struct TaskCurvature {
  double bend = 0.;       ///< change of its Jacobian per change of q
  bool is_stuck = false;  ///< the last step left most of its residual

  /// The curvature that its linear model lacks: the residual times the change of its Jacobian. A task that a step
  /// attains, such as a target in reach that trembles, has none.
  double of(const VectorXd& residual) const { return is_stuck ? residual.norm() * bend : 0.; }
};

/// Damps joints whose step takes back the one before. Where a target is out of reach, the linear model of a task
/// promises progress that the curvature of the motion denies, and steps would jump back and forth at the velocity
/// limits.
class ChatterDamping {
 public:
  /// Forgets all steps of `dofs` joints.
  void reset(int dofs) { damping_.setZero(dofs), before_.setZero(dofs), moved_ = 0.; }

  /// Length of the last step if it was long enough to tell a curvature, else 0.
  double moved() const { return moved_; }

  /// The damping of each joint, relative to the curvature of the tasks.
  const VectorXd& damping() const { return damping_; }

  /// Takes the change of q of a step.
  void add(const VectorXd& change);

 private:
  VectorXd damping_;
  VectorXd before_;  ///< last steps of the joints that moved
  double moved_ = 0.;
};

}  // namespace kinegraph::inline control_internal
