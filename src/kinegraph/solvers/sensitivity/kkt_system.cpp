#include "kinegraph/solvers/sensitivity/kkt_system.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace kinegraph::inline solvers_internal {

namespace {

constexpr double kPenalty = 1e3;     // mu, relative to the largest curvature
constexpr double kSingular = 1e-13;  // largest ratio of pivot and diagonal entry that counts as rounding
constexpr double kDamping = 1e-10;   // of a singular system, relative to the largest curvature
constexpr double kFree = 1e-6;       // largest pivot of a free direction, relative to the largest curvature
constexpr double kFlat =
    1e-4;  // least divisor of a row, relative to the longest one, so that short rows keep little weight
constexpr int kMaxRefinementSteps = 200;  // refinement ends earlier without progress
constexpr int kLargestDense = 1200;       // largest number of variables and rows

std::vector<int> upTo(std::size_t count) {
  std::vector<int> list(count);
  std::iota(list.begin(), list.end(), 0);
  return list;
}

}  // namespace

KktSystem::KktSystem(const Nlp& nlp, const Jacobian& pattern, bool full)
    : n_(nlp.dimension()),
      rows_(upTo(nlp.types().size())),
      algebra_(nlp, pattern, rows_, full),
      norms_(VectorXd::Zero(Eigen::Index(rows_.size()))) {
  for (const int row : rows_) is_linear_.push_back(nlp.isLinear(row));
}

BandAlgebra& KktSystem::begin(const Jacobian& J, const std::vector<int>& squared) {
  J_ = J;
  algebra_.setJacobian(J_);
  linear_now_.clear();
  std::ranges::copy_if(squared, std::back_inserter(linear_now_), [&](int row) { return is_linear_[std::size_t(row)]; });
  if (linear_now_ != linear_costs_) {
    algebra_.setLinearCosts(linear_now_);
    linear_costs_ = linear_now_;
  }
  algebra_.copyLinearCosts();
  for (const int row : squared) {
    if (!is_linear_[std::size_t(row)]) algebra_.addCost(row, 2.);
  }
  for (int row = 0; row < int(rows_.size()); ++row) {
    double square = 0.;
    for (const Jacobian::Segment& segment : J_.row_segments(row)) {
      if (J_.zero_row[std::size_t(row)]) break;
      for (int i = 0; i < segment.width; ++i) {
        const double value = J_.values[std::size_t(segment.offset + i)];
        square += value * value;
      }
    }
    norms_[row] = std::sqrt(square);
  }
  return algebra_;
}

double KktSystem::largestCurvature() const {
  double largest = 0.;
  for (int i = 0; i < n_; ++i) largest = std::max(largest, std::abs(algebra_.diagonal(i)));
  return largest;
}

int KktSystem::pivotsBelow(double least) const {
  int count = 0;
  for (int i = 0; i < n_; ++i) count += !fixed_[std::size_t(i)] && algebra_.pivot(i) < least;
  return count;
}

/// Without costs, H becomes the identity, which leads to the shortest dx.
bool KktSystem::factorize(const std::vector<int>& active, const std::vector<char>& fixed) {
  active_ = active;
  fixed_ = fixed;
  free_ = 0;
  damping_ = 0.;
  is_indefinite_ = false;
  VectorXd diagonal(n_);
  for (int i = 0; i < n_; ++i) diagonal[i] = algebra_.diagonal(i);
  double longest = 0.;
  for (const int row : active_) longest = std::max(longest, norms_[row]);
  units_.resize(Eigen::Index(active_.size()));
  for (std::size_t k = 0; k < active_.size(); ++k) {
    units_[Eigen::Index(k)] = std::max(norms_[active_[k]], kFlat * longest);
    if (norms_[active_[k]] == 0.) continue;
    for (const Jacobian::Segment& segment : J_.row_segments(active_[k])) {
      for (int i = 0; i < segment.width; ++i) J_.values[std::size_t(segment.offset + i)] /= units_[Eigen::Index(k)];
    }
  }
  double largest = largestCurvature();
  if (largest == 0.) {
    if (algebra_.factorize(kDamping, 1., active_, fixed_, 0)) free_ = pivotsBelow(kFree);
    for (int i = 0; i < n_; ++i) algebra_.addEntry(i, i, 1.);
    diagonal.setOnes();
    largest = 1.;
  }
  largest_ = largest;
  mu_ = kPenalty * largest;
  for (const int row : active_) {
    if (norms_[row] == 0.) continue;
    for (const Jacobian::Segment& segment : J_.row_segments(row)) {
      for (int i = 0; i < segment.width; ++i) {
        const double value = J_.values[std::size_t(segment.offset + i)];
        diagonal[segment.column + i] += mu_ * value * value;
      }
    }
  }
  if (algebra_.factorize(0., mu_, active_, fixed_, 0)) {
    bool is_singular = false;
    for (int i = 0; i < n_; ++i)
      is_singular = is_singular || (!fixed_[std::size_t(i)] && !(algebra_.pivot(i) > kSingular * diagonal[i]));
    if (!is_singular) return true;
  }
  damping_ = kDamping * largest;
  if (algebra_.factorize(damping_, mu_, active_, fixed_, 0)) {
    free_ = pivotsBelow(kFree * largest);
    return true;
  }
  return factorizeDense();
}

/// Computes a dense H from its products with unit vectors.
bool KktSystem::factorizeDense() {
  const Eigen::Index m = Eigen::Index(active_.size());
  is_indefinite_ = true;
  damping_ = 0.;
  if (n_ + m > kLargestDense) return false;
  dense_H_.setZero(n_, n_);
  VectorXd column(n_);
  for (int i = 0; i < n_; ++i) {
    column.setZero();
    algebra_.addHessianProduct(VectorXd::Unit(n_, i), column);
    dense_H_.col(i) = column;
  }
  dense_A_.setZero(m, n_);
  for (Eigen::Index k = 0; k < m; ++k) {
    VectorXd row = VectorXd::Zero(n_);
    if (norms_[active_[std::size_t(k)]] > 0.) J_.addRowTo(active_[std::size_t(k)], 1., row);
    dense_A_.row(k) = row;
  }
  MatrixXd matrix = MatrixXd::Zero(n_ + m, n_ + m);
  matrix.topLeftCorner(n_, n_) = dense_H_;
  matrix.bottomLeftCorner(m, n_) = dense_A_;
  matrix.topRightCorner(n_, m) = dense_A_.transpose();
  for (int i = 0; i < n_; ++i) {
    if (!fixed_[std::size_t(i)]) continue;
    matrix.row(i).setZero();
    matrix.col(i).setZero();
    matrix(i, i) = 1.;
  }
  dense_.setThreshold(1e-11);
  dense_.compute(matrix);
  return true;
}

/// Computes the residuals r1 and r2. Returns their size relative to that of their terms.
double KktSystem::setResiduals(const VectorXd& dx, const VectorXd& dl) {
  product_.setZero(n_);
  algebra_.addHessianProduct(dx, product_);
  const double a = a_.lpNorm<Eigen::Infinity>(), b = b_.size() > 0 ? b_.lpNorm<Eigen::Infinity>() : 0.;
  double of_a = std::max({a, product_.lpNorm<Eigen::Infinity>(), largest_ * b});
  r1_ = a_ - product_;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const Eigen::Index at = Eigen::Index(k);
    const bool is_zero = norms_[active_[k]] == 0.;
    if (!is_zero) J_.addRowTo(active_[k], -dl[at], r1_);
    of_a = std::max(of_a, std::abs(dl[at]));
    r2_[at] = b_[at] - (is_zero ? 0. : J_.rowTimes(active_[k], dx));
  }
  const double of_b = std::max({b, dx.lpNorm<Eigen::Infinity>(), a / largest_});
  for (int i = 0; i < n_; ++i) {
    if (fixed_[std::size_t(i)]) r1_[i] = 0.;
  }
  const double e1 = r1_.lpNorm<Eigen::Infinity>(), e2 = r2_.size() > 0 ? r2_.lpNorm<Eigen::Infinity>() : 0.;
  return std::max(e1 > 0. ? e1 / of_a : 0., e2 > 0. ? e2 / of_b : 0.);
}

double KktSystem::refined(VectorXd& dx, VectorXd& dl, double accuracy) {
  double error = setResiduals(dx, dl);
  VectorXd best_dx = dx, best_dl = dl;
  double best = error;
  int slow = 0;
  for (int i = 0; i < kMaxRefinementSteps && best > accuracy && slow < 3; ++i) {
    step_ = r1_;
    for (std::size_t k = 0; k < active_.size(); ++k) {
      if (norms_[active_[k]] > 0.) J_.addRowTo(active_[k], mu_ * r2_[Eigen::Index(k)], step_);
    }
    for (int v = 0; v < n_; ++v) {
      if (fixed_[std::size_t(v)]) step_[v] = 0.;
    }
    algebra_.solve(step_);
    for (std::size_t k = 0; k < active_.size(); ++k) {
      if (norms_[active_[k]] > 0.) dl[Eigen::Index(k)] += mu_ * (J_.rowTimes(active_[k], step_) - r2_[Eigen::Index(k)]);
    }
    dx += step_;
    error = setResiduals(dx, dl);
    slow = error < .5 * best ? 0 : slow + 1;
    if (!(error < best)) continue;
    best = error;
    best_dx = dx;
    best_dl = dl;
  }
  dx = best_dx;
  dl = best_dl;
  return best;
}

void KktSystem::solveDense(VectorXd& dx, VectorXd& dl) const {
  VectorXd right(n_ + b_.size());
  VectorXd fixed_dx = VectorXd::Zero(n_);
  for (int i = 0; i < n_; ++i) {
    if (fixed_[std::size_t(i)]) fixed_dx[i] = dx[i];
  }
  right.head(n_) = a_ - dense_H_ * fixed_dx;
  right.tail(b_.size()) = b_ - dense_A_ * fixed_dx;
  for (int i = 0; i < n_; ++i) {
    if (fixed_[std::size_t(i)]) right[i] = fixed_dx[i];
  }
  const VectorXd solved = dense_.solve(right);
  dx = solved.head(n_);
  dl = solved.tail(b_.size());
}

double KktSystem::solve(const VectorXd& a, const VectorXd& b, VectorXd& dx, VectorXd& dl, double accuracy) {
  a_ = a;
  b_ = b;
  r2_.resize(b.size());
  for (std::size_t k = 0; k < active_.size(); ++k) {
    if (norms_[active_[k]] > 0.) b_[Eigen::Index(k)] /= units_[Eigen::Index(k)];
  }
  for (int i = 0; i < n_; ++i) (fixed_[std::size_t(i)] ? a_ : dx)[i] = 0.;
  dl.setZero(b.size());
  double error = 0.;
  if (is_indefinite_) {
    solveDense(dx, dl);
    error = setResiduals(dx, dl);
  } else {
    error = refined(dx, dl, accuracy);
  }
  for (std::size_t k = 0; k < active_.size(); ++k) {
    if (norms_[active_[k]] > 0.) dl[Eigen::Index(k)] /= units_[Eigen::Index(k)];
  }
  return error;
}

VectorXd KktSystem::leftBy(const VectorXd& v, const VectorXd& w, const VectorXd& u) {
  product_.setZero(n_);
  algebra_.addHessianProduct(w, product_);
  VectorXd left = v - product_;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    if (norms_[active_[k]] > 0.) J_.addRowTo(active_[k], -u[Eigen::Index(k)] * units_[Eigen::Index(k)], left);
  }
  return left;
}

}  // namespace kinegraph::inline solvers_internal
