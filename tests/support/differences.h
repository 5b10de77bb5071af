#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// The Jacobian of a function by central differences, and whether the function has one.
struct Differences {
  MatrixXd D;

  /// False if the function's own values show that it is not differentiable: differences of two step sizes, or
  /// those to the left and to the right, disagree. No analytic Jacobian is read, so a wrong one cannot hide here.
  bool differentiable = true;
};

inline Differences differences(const std::function<VectorXd(const VectorXd&)>& function, const VectorXd& x,
                               double step = 1e-5) {
  const VectorXd middle = function(x);
  Differences out;
  out.D.resize(middle.size(), x.size());
  for (int i = 0; i < x.size(); ++i) {
    const auto at = [&](double move) {
      VectorXd moved = x;
      moved[i] += move;
      return function(moved);
    };
    const VectorXd plus = at(step), minus = at(-step), far = (at(2. * step) - at(-2. * step)) / (4. * step);
    const VectorXd near = (plus - minus) / (2. * step);
    out.D.col(i) = near + (near - far) / 3.;  // free of the error of order step^2
    const double scale = std::max(1., near.lpNorm<Eigen::Infinity>());
    const double bend = (plus - 2. * middle + minus).lpNorm<Eigen::Infinity>() / step;
    if ((near - far).lpNorm<Eigen::Infinity>() > 1e-6 * scale || bend > 1e-2 * scale) out.differentiable = false;
  }
  return out;
}

/// max |A - B| / max(1, |B|), over all entries.
inline double relativeError(const MatrixXd& A, const MatrixXd& B) {
  if (A.rows() != B.rows() || A.cols() != B.cols()) return std::nan("");
  if (A.size() == 0) return 0.;
  return ((A - B).array().abs() / B.array().abs().max(1.)).maxCoeff();
}

}  // namespace kinegraph
