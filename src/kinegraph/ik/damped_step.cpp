#include "kinegraph/ik/damped_step.h"

#include "kinegraph/ik/damped_rows.h"

namespace kinegraph::inline ik_internal {

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
  atLeast(keep_, columns);
  if (step_.size() != columns) step_.resize(columns);
}

void DampedStep::solve(const double* x, const double* lower, const double* upper, const double* longest, double damping,
                       const double* preferred) {
  const lanes::DampedRows<double> rows{
      rows_, columns_, J_.data(),    e_.data(),    preferred, x,         lower,
      upper, longest,  keep_.data(), step_.data(), A_.data(), y_.data(), inverse_pivots_.data()};
  lanes::dampedStep(rows, damping);
  for (int c = 0; c < columns_; ++c) step_[c] -= x[c];
}

double DampedStep::damping(double square) { return lanes::dampingOf(square); }

}  // namespace kinegraph::inline ik_internal
