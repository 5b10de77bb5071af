#pragma once

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// An estimate of a Hessian from changes of the gradient: damped BFGS, which stays positive definite.
/// Source: Nocedal & Wright, Numerical Optimization, 2nd ed., procedure 18.2.
class QuasiNewton {
 public:
  void reset(int n) { B_.setZero(n, n), empty_ = true; }

  /// The gradient changed by `y` over the step `s`.
  void update(const VectorXd& s, const VectorXd& y);

  const MatrixXd& matrix() const { return B_; }
  bool empty() const { return empty_; }  ///< nothing is known yet; the matrix is zero

 private:
  MatrixXd B_;
  VectorXd Bs_, r_;
  bool empty_ = true;
};

}  // namespace kinegraph
