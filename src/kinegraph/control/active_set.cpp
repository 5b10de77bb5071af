#include "kinegraph/control/active_set.h"

#include <cmath>
#include <limits>

namespace kinegraph {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kMissed = 1e-12;     // by which a row counts as held, in units of its terms
constexpr double kDependent = 1e-12;  // share of a normal that others do not span, below which they do

}  // namespace

void ActiveSet::resize(int size, int rows) {
  if (size != size_) {
    size_ = size;
    for (Eigen::MatrixXd* matrix : {&hessian_, &factor_, &basis_, &triangle_}) matrix->resize(size, size);
    for (Eigen::VectorXd* vector : {&gradient_, &x_, &step_, &turned_}) vector->resize(size);
    change_.resize(size + 1), multipliers_.resize(size + 1);
    active_.resize(std::size_t(size) + 1);
  }
  if (rows > normals_.cols() || normals_.rows() != size) {
    normals_.resize(size, rows);
    bounds_.resize(rows);
    is_active_.resize(std::size_t(rows));
  }
  rows_ = 0;
}

/// Of the rows that do not hold, the one that is missed by most.
int ActiveSet::mostMissed() const {
  int found = -1;
  double most = 0.;
  for (int r = 0; r < rows_; ++r) {
    if (is_active_[std::size_t(r)]) continue;
    const double value = normals_.col(r).dot(x_), miss = bounds_[r] - value;
    if (miss > most && miss > kMissed * (std::abs(value) + std::abs(bounds_[r]) + 1e-3)) most = miss, found = r;
  }
  return found;
}

/// Turns the basis so that the new normal is spanned by its first columns.
void ActiveSet::addActive(int row) {
  for (int k = size_ - 1; k > active_count_; --k) {
    const double a = turned_[k - 1], b = turned_[k], length = std::hypot(a, b);
    if (b == 0.) continue;
    const double c = a / length, s = b / length;
    turned_[k - 1] = length, turned_[k] = 0.;
    for (int i = 0; i < size_; ++i) {
      const double x = basis_(i, k - 1), y = basis_(i, k);
      basis_(i, k - 1) = c * x + s * y, basis_(i, k) = c * y - s * x;
    }
  }
  triangle_.col(active_count_).head(active_count_ + 1) = turned_.head(active_count_ + 1);
  active_[std::size_t(active_count_++)] = row;
  is_active_[std::size_t(row)] = 1;
}

void ActiveSet::dropActive(int place) {
  is_active_[std::size_t(active_[std::size_t(place)])] = 0;
  for (int k = place; k + 1 < active_count_; ++k) {
    active_[std::size_t(k)] = active_[std::size_t(k) + 1];
    multipliers_[k] = multipliers_[k + 1];
    triangle_.col(k).head(k + 2) = triangle_.col(k + 1).head(k + 2);
  }
  multipliers_[active_count_ - 1] = multipliers_[active_count_];
  --active_count_;
  for (int k = place; k < active_count_; ++k) {  // what is below the diagonal now
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

/// Goes until a row holds; rows that hinder it are dropped on the way. False if they all are needed.
bool ActiveSet::enter(int row) {
  multipliers_[active_count_] = 0.;
  for (int guard = 0; guard <= rows_ + size_; ++guard) {
    const int count = active_count_, free = size_ - count;
    turned_.noalias() = basis_.transpose() * normals_.col(row);
    step_.noalias() = basis_.rightCols(free) * turned_.tail(free);
    for (int k = count - 1; k >= 0; --k) {  // how the multipliers of the others fall
      double value = turned_[k];
      for (int j = k + 1; j < count; ++j) value -= triangle_(k, j) * change_[j];
      change_[k] = value / triangle_(k, k);
    }
    double until_zero = kInfinite;
    int leaving = -1;
    for (int k = 0; k < count; ++k)
      if (change_[k] > 0. && multipliers_[k] / change_[k] < until_zero)
        until_zero = multipliers_[k] / change_[k], leaving = k;
    const double slope = turned_.tail(free).squaredNorm();
    const bool is_spanned = slope <= kDependent * turned_.squaredNorm();
    const double until_held = is_spanned ? kInfinite : (bounds_[row] - normals_.col(row).dot(x_)) / slope;
    const double way = std::min(until_zero, until_held);
    if (way == kInfinite) return false;
    if (!is_spanned) x_ += way * step_;
    for (int k = 0; k < count; ++k) multipliers_[k] -= way * change_[k];
    multipliers_[count] += way;
    if (until_held <= until_zero) {
      addActive(row);
      return true;
    }
    dropActive(leaving);
  }
  return false;
}

bool ActiveSet::solve() {
  active_count_ = 0;
  std::fill(is_active_.begin(), is_active_.end(), char(0));
  for (int j = 0; j < size_; ++j) {  // Cholesky's L, column by column
    double diagonal = hessian_(j, j);
    for (int k = 0; k < j; ++k) diagonal -= factor_(j, k) * factor_(j, k);
    if (!(diagonal > 0.)) return false;
    factor_(j, j) = std::sqrt(diagonal);
    for (int i = j + 1; i < size_; ++i) {
      double value = hessian_(i, j);
      for (int k = 0; k < j; ++k) value -= factor_(i, k) * factor_(j, k);
      factor_(i, j) = value / factor_(j, j);
    }
  }
  for (int j = 0; j < size_; ++j) {  // L^-T: column j solves L^T b = e_j
    for (int i = size_ - 1; i >= 0; --i) {
      double value = i == j ? 1. : 0.;
      for (int k = i + 1; k <= j; ++k) value -= factor_(k, i) * basis_(k, j);
      basis_(i, j) = i > j ? 0. : value / factor_(i, i);
    }
  }
  turned_.noalias() = basis_.transpose() * gradient_;
  x_.noalias() = -basis_ * turned_;
  for (int guard = 0; guard < 10 * (rows_ + size_); ++guard) {
    const int row = mostMissed();
    if (row < 0) return true;
    if (!enter(row)) return false;
  }
  return false;
}

}  // namespace kinegraph
