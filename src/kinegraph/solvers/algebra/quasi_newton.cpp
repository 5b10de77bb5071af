#include "kinegraph/solvers/algebra/quasi_newton.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline solvers_internal {

void QuasiNewton::update(const VectorXd& s, const VectorXd& y) {
  const double ss = s.cwiseQuotient(unit_).squaredNorm(), sy = s.dot(y);
  if (!(ss > 1e-24) || !y.allFinite()) return;
  if (empty_) {  // the first estimate has the size of the curvature along the step, in units
    const double yy = unit_.cwiseProduct(y).squaredNorm();
    if (yy <= 1e-24 * ss) return;
    const double curvature = sy > 1e-8 * std::sqrt(ss * yy) ? yy / sy : std::sqrt(yy) / std::sqrt(ss);
    B_.diagonal() = curvature * unit_.cwiseAbs2().cwiseInverse();
    empty_ = false;
  }
  Bs_.noalias() = B_ * s;
  const double sBs = s.dot(Bs_);
  if (!(sBs > 1e-20 * ss)) return;
  const double theta = sy >= .2 * sBs ? 1. : .8 * sBs / (sBs - sy);
  r_ = theta * y + (1. - theta) * Bs_;
  B_ += r_ * r_.transpose() / s.dot(r_) - Bs_ * Bs_.transpose() / sBs;
}

}  // namespace kinegraph::inline solvers_internal
