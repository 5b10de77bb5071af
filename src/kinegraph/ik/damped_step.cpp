#include "kinegraph/ik/damped_step.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {

void DampedStep::resize(int rows, int columns) {
  const auto atLeast = [](auto& values, std::size_t size) {
    if (values.size() < size) values.resize(size);
  };
  rows_ = rows;
  columns_ = columns;
  atLeast(J_, std::size_t(rows) * columns);
  atLeast(A_, std::size_t(rows) * rows);
  atLeast(e_, rows);
  atLeast(y_, rows);
  atLeast(inverse_pivots_, rows);
  atLeast(held_, columns);
  if (step_.size() != columns) step_.resize(columns);
}

/// step = pull + J^T (J J^T + damping)^-1 (e - J pull) for the variables that are not held; 0 for the others.
template <int Rows>
void DampedStep::solveRows(const double* pull, double damping) {
  const int m = Rows > 0 ? Rows : rows_;
  double* A = A_.data();  // lower triangle, row by row
  double* y = y_.data();
  for (int r = 0; r < m; ++r) {
    std::fill(A + r * m, A + r * m + r + 1, 0.);
    A[r * m + r] = damping;
    y[r] = e_[r];
  }
  for (int c = 0; c < columns_; ++c) {
    if (held_[c]) continue;
    const double* J = J_.data() + std::ptrdiff_t(c) * m;
    for (int r = 0; r < m; ++r) {
      for (int s = 0; s <= r; ++s) A[r * m + s] += J[r] * J[s];
    }
    if (!pull) continue;
    for (int r = 0; r < m; ++r) y[r] -= J[r] * pull[c];
  }
  for (int r = 0; r < m; ++r) {  // A = L D L^T in place, and y = L^-1 y on the way
    double* row = A + r * m;
    double pivot = row[r];
    for (int s = 0; s < r; ++s) {
      double value = row[s];
      for (int t = 0; t < s; ++t) value -= A[s * m + t] * row[t];
      row[s] = value;  // L_rs D_s
    }
    double right = y[r];
    for (int s = 0; s < r; ++s) {
      const double value = row[s] * inverse_pivots_[s];
      pivot -= row[s] * value;
      row[s] = value;
      right -= value * y[s];
    }
    y[r] = right;
    inverse_pivots_[r] = 1. / std::max(pivot, 1e-3 * damping);
  }
  for (int r = m - 1; r >= 0; --r) {
    double value = y[r] * inverse_pivots_[r];
    for (int s = r + 1; s < m; ++s) value -= A[s * m + r] * y[s];
    y[r] = value;
  }
  for (int c = 0; c < columns_; ++c) {
    const double* J = J_.data() + std::ptrdiff_t(c) * m;
    double value = 0.;
    for (int r = 0; r < m; ++r) value += J[r] * y[r];
    step_[c] = held_[c] ? 0. : value + (pull ? pull[c] : 0.);
  }
}

void DampedStep::solve(const double* x, const double* lower, const double* upper, const double* longest, double damping,
                       const double* pull) {
  std::fill_n(held_.begin(), columns_, char(0));
  for (int pass = 0; pass < 4; ++pass) {
    switch (rows_) {
      case 3:
        solveRows<3>(pull, damping);
        break;
      case 6:
        solveRows<6>(pull, damping);
        break;
      default:
        solveRows<0>(pull, damping);
        break;
    }
    bool changed = false;
    for (int c = 0; c < columns_; ++c) {
      if (held_[c] || !((step_[c] < 0. && x[c] <= lower[c]) || (step_[c] > 0. && x[c] >= upper[c]))) continue;
      held_[c] = 1;
      changed = true;
    }
    if (!changed) break;
  }
  double excess = 1.;
  for (int c = 0; c < columns_; ++c) excess = std::max(excess, std::abs(step_[c]) / longest[c]);
  for (int c = 0; c < columns_; ++c) {
    const double step = std::isfinite(longest[c]) ? step_[c] / excess : step_[c];
    step_[c] = std::clamp(x[c] + step, lower[c], upper[c]) - x[c];
  }
}

}  // namespace kinegraph
