#include "kinegraph/solvers/algebra/dual_active_set.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinegraph::inline solvers_internal {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kViolationRounding = 1e-12;  // an inequality counts as violated beyond this share of its terms
constexpr double kSmallestTerm = 1e-3;        // least magnitude of these terms
constexpr double kRedundantError = 1e-9;      // largest error of an equality that the others imply

}  // namespace

void DualActiveSet::resize(int variables, int constraints) {
  if (variables != size_) {
    size_ = variables;
    for (Eigen::MatrixXd* matrix : {&hessian_, &factor_, &basis_, &triangle_}) matrix->resize(size_, size_);
    for (Eigen::VectorXd* vector : {&gradient_, &x_, &step_, &projection_}) vector->resize(size_);
    decrease_.resize(size_ + 1), multipliers_.resize(size_ + 1);
    active_.resize(std::size_t(size_) + 1);
  }
  if (constraints > normals_.cols() || normals_.rows() != size_) {
    normals_.resize(size_, constraints);
    bounds_.resize(constraints);
    is_active_.resize(std::size_t(constraints));
  }
  clear();
}

/// Computes L by Cholesky's method and L^-T. False if H is not positive definite.
bool DualActiveSet::factorize() {
  factor_.triangularView<Eigen::Lower>() = hessian_;
  for (int k = 0; k < size_; ++k) {
    const double diagonal = factor_(k, k);
    if (!(diagonal > 0.)) return false;
    const int rest = size_ - k - 1;
    factor_(k, k) = std::sqrt(diagonal);
    factor_.col(k).tail(rest) /= factor_(k, k);
    for (int j = k + 1; j < size_; ++j)
      factor_.col(j).tail(size_ - j) -= factor_(j, k) * factor_.col(k).tail(size_ - j);
  }
  for (int j = 0; j < size_; ++j) {  // column j solves L' b = e_j
    for (int i = size_ - 1; i >= 0; --i) {
      double value = i == j ? 1. : 0.;
      for (int k = i + 1; k <= j; ++k) value -= factor_(k, i) * basis_(k, j);
      basis_(i, j) = i > j ? 0. : value / factor_(i, i);
    }
  }
  return true;
}

/// Returns the most violated inequality, or -1 if all hold.
int DualActiveSet::mostViolated() const {
  const double smallest_term = std::max(kSmallestTerm, x_.size() > 0 ? x_.lpNorm<Eigen::Infinity>() : 0.);
  int found = -1;
  double largest = 0.;
  for (int i = equalities_; i < constraints_; ++i) {
    if (is_active_[std::size_t(i)]) continue;
    const double value = normals_.col(i).dot(x_), violation = bounds_[i] - value;
    if (violation > largest &&
        violation > kViolationRounding * (std::abs(value) + std::abs(bounds_[i]) + smallest_term))
      largest = violation, found = i;
  }
  return found;
}

/// Computes how x (step_) and, negated, the active multipliers (decrease_) change per unit of a constraint's
/// multiplier.
void DualActiveSet::project(int constraint) {
  const int count = active_count_, free = size_ - count;
  projection_.noalias() = basis_.transpose() * normals_.col(constraint);
  step_.noalias() = basis_.rightCols(free) * projection_.tail(free);
  for (int k = count - 1; k >= 0; --k) {
    double value = projection_[k];
    for (int j = k + 1; j < count; ++j) value -= triangle_(k, j) * decrease_[j];
    decrease_[k] = value / triangle_(k, k);
  }
}

/// Moves to the equality. All constraints that are active before are equalities, whose multipliers have any sign.
QuadraticStatus DualActiveSet::activateEquality(int constraint) {
  project(constraint);
  const double error = bounds_[constraint] - normals_.col(constraint).dot(x_);
  const double slope = projection_.tail(size_ - active_count_).squaredNorm();
  if (isDependent(slope))
    return std::abs(error) <= kRedundantError * (1. + std::abs(bounds_[constraint])) ? QuadraticStatus::solved
                                                                                     : QuadraticStatus::infeasible;
  const double length = error / slope;
  x_ += length * step_;
  for (int k = 0; k < active_count_; ++k) multipliers_[k] -= length * decrease_[k];
  multipliers_[active_count_] = length;
  append(constraint);
  return QuadraticStatus::solved;
}

/// Moves until the inequality holds. Active inequalities whose multipliers reach zero before are removed.
QuadraticStatus DualActiveSet::activateInequality(int constraint) {
  multipliers_[active_count_] = 0.;
  for (int pass = 0; pass <= constraints_ + size_; ++pass) {
    project(constraint);
    const int count = active_count_;
    double until_zero = kInfinity;
    int leaving = -1;
    for (int k = equalities_active_; k < count; ++k)
      if (decrease_[k] > 0. && multipliers_[k] / decrease_[k] < until_zero)
        until_zero = multipliers_[k] / decrease_[k], leaving = k;
    const double slope = projection_.tail(size_ - count).squaredNorm();
    const bool is_dependent = isDependent(slope);
    const double until_held =
        is_dependent ? kInfinity : (bounds_[constraint] - normals_.col(constraint).dot(x_)) / slope;
    const double length = std::min(until_zero, until_held);
    if (length == kInfinity) return QuadraticStatus::infeasible;
    if (!is_dependent) x_ += length * step_;
    for (int k = 0; k < count; ++k) multipliers_[k] -= length * decrease_[k];
    multipliers_[count] += length;
    if (until_held <= until_zero) {
      append(constraint);
      return QuadraticStatus::solved;
    }
    remove(leaving);
  }
  return QuadraticStatus::stalled;
}

/// Appends the constraint's normal to the factors: Givens rotations of the basis make its projection triangular.
void DualActiveSet::append(int constraint) {
  for (int k = size_ - 1; k > active_count_; --k) {
    const double a = projection_[k - 1], b = projection_[k], length = std::hypot(a, b);
    if (b == 0.) continue;
    const double c = a / length, s = b / length;
    projection_[k - 1] = length, projection_[k] = 0.;
    for (int i = 0; i < size_; ++i) {
      const double x = basis_(i, k - 1), y = basis_(i, k);
      basis_(i, k - 1) = c * x + s * y, basis_(i, k) = c * y - s * x;
    }
  }
  triangle_.col(active_count_).head(active_count_ + 1) = projection_.head(active_count_ + 1);
  active_[std::size_t(active_count_++)] = constraint;
  is_active_[std::size_t(constraint)] = 1;
}

/// Removes an active constraint from the factors. The multiplier behind the last one, of the constraint that is
/// being activated, moves along.
void DualActiveSet::remove(int removed) {
  is_active_[std::size_t(active_[std::size_t(removed)])] = 0;
  for (int k = removed; k + 1 < active_count_; ++k) {
    active_[std::size_t(k)] = active_[std::size_t(k) + 1];
    multipliers_[k] = multipliers_[k + 1];
    triangle_.col(k).head(k + 2) = triangle_.col(k + 1).head(k + 2);
  }
  multipliers_[active_count_ - 1] = multipliers_[active_count_];
  --active_count_;
  for (int k = removed; k < active_count_; ++k) {  // entries below the diagonal vanish
    const double a = triangle_(k, k), b = triangle_(k + 1, k), length = std::hypot(a, b);
    if (length == 0.) continue;
    const double c = a / length, s = b / length;
    for (int j = k; j < active_count_; ++j) {
      const double x = triangle_(k, j), y = triangle_(k + 1, j);
      triangle_(k, j) = c * x + s * y, triangle_(k + 1, j) = c * y - s * x;
    }
    for (int i = 0; i < size_; ++i) {
      const double x = basis_(i, k), y = basis_(i, k + 1);
      basis_(i, k) = c * x + s * y, basis_(i, k + 1) = c * y - s * x;
    }
  }
}

QuadraticStatus DualActiveSet::solve() {
  active_count_ = 0;
  std::fill(is_active_.begin(), is_active_.end(), char(0));
  if (!factorize()) return QuadraticStatus::notConvex;
  projection_.noalias() = basis_.transpose() * gradient_;
  x_.noalias() = -basis_ * projection_;
  for (int i = 0; i < equalities_; ++i)
    if (const QuadraticStatus status = activateEquality(i); status != QuadraticStatus::solved) return status;
  equalities_active_ = active_count_;
  for (int pass = 0; pass < 10 * (constraints_ + size_); ++pass) {
    const int constraint = mostViolated();
    if (constraint < 0) return QuadraticStatus::solved;
    if (const QuadraticStatus status = activateInequality(constraint); status != QuadraticStatus::solved) return status;
  }
  return QuadraticStatus::stalled;
}

}  // namespace kinegraph::inline solvers_internal
