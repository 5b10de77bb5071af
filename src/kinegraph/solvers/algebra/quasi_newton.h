#pragma once

#include "kinegraph/math/pose.h"

namespace kinegraph::inline solvers_internal {

/// Estimates a Hessian from changes of the gradient by damped BFGS, which keeps it positive definite.
/// Source: Nocedal & Wright, Numerical Optimization, 2nd ed., procedure 18.2.
class QuasiNewton {
 public:
  void reset(int n) { reset(VectorXd::Ones(n)); }

  /// Resets the estimate; in these units, the first one is a multiple of the identity.
  void reset(const VectorXd& unit) {
    unit_ = unit;
    B_.setZero(unit.size(), unit.size());
    empty_ = true;
  }

  /// Updates the estimate: the gradient changed by `y` over the step `s`.
  void update(const VectorXd& s, const VectorXd& y);

  const MatrixXd& matrix() const { return B_; }
  bool empty() const { return empty_; }  ///< whether there was no update; the matrix is zero

 private:
  MatrixXd B_;
  VectorXd unit_, Bs_, r_;
  bool empty_ = true;
};

}  // namespace kinegraph::inline solvers_internal
