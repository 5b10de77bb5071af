#pragma once

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// An estimate of a Hessian from changes of the gradient: damped BFGS, which stays positive definite.
/// Source: Nocedal & Wright, Numerical Optimization, 2nd ed., procedure 18.2.
class QuasiNewton {
 public:
  void reset(int n) { reset(VectorXd::Ones(n)); }

  /// In these units, the first estimate is a multiple of the identity.
  void reset(const VectorXd& unit) {
    unit_ = unit;
    B_.setZero(unit.size(), unit.size());
    empty_ = true;
  }

  /// The gradient changed by `y` over the step `s`.
  void update(const VectorXd& s, const VectorXd& y);

  const MatrixXd& matrix() const { return B_; }
  bool empty() const { return empty_; }  ///< nothing is known yet; the matrix is zero

 private:
  MatrixXd B_;
  VectorXd unit_, Bs_, r_;
  bool empty_ = true;
};

}  // namespace kinegraph
