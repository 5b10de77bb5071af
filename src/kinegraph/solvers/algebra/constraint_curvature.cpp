#include "kinegraph/solvers/algebra/constraint_curvature.h"

#include <cmath>

namespace kinegraph::inline solvers_internal {

namespace {

constexpr double kNoChange = 1e-12;    ///< relative change of a gradient that counts as none
constexpr double kLeastCosine = 1e-8;  ///< of step and error, for a reliable update

}  // namespace

void ConstraintCurvature::reset(const std::vector<int>& rows, int n) {
  rows_ = rows;
  B_.assign(rows.size(), MatrixXd());
  r_.setZero(n);
}

void ConstraintCurvature::update(const VectorXd& s, const Jacobian& before, const Jacobian& after) {
  const double length = s.norm();
  if (!(length > 0.)) return;
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    r_.setZero();
    after.addRowTo(rows_[j], 1., r_);
    const double size = r_.norm();
    before.addRowTo(rows_[j], -1., r_);
    MatrixXd& B = B_[j];
    if (B.size() > 0) r_.noalias() -= B * s;
    const double rs = r_.dot(s);
    if (!r_.allFinite() || r_.norm() <= kNoChange * size || std::abs(rs) <= kLeastCosine * r_.norm() * length) continue;
    if (B.size() == 0) B.setZero(s.size(), s.size());
    B.noalias() += r_ * r_.transpose() / rs;
  }
}

void ConstraintCurvature::addTo(MatrixXd& H, const VectorXd& multipliers) const {
  for (std::size_t j = 0; j < B_.size(); ++j) {
    if (B_[j].size() > 0 && multipliers[Eigen::Index(j)] != 0.) H += multipliers[Eigen::Index(j)] * B_[j];
  }
}

MatrixXd ConstraintCurvature::observed(const VectorXd& multipliers) const {
  MatrixXd rows(0, r_.size());
  for (std::size_t j = 0; j < B_.size(); ++j) {
    if (B_[j].size() == 0 || multipliers[Eigen::Index(j)] == 0.) continue;
    const MatrixXd B = B_[j] / B_[j].norm();
    if (rows.rows() == 0) rows.setZero(r_.size(), r_.size());
    rows += B.transpose() * B;
  }
  return rows;
}

}  // namespace kinegraph::inline solvers_internal
