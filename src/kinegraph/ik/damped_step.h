#pragma once

#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph::inline ik_internal {

/// The step dx of a bounded damped least squares problem, computed in the space of the rows, which are few:
///
///     min |J dx - e|^2 + damping |dx - preferred|^2      lower <= x + dx <= upper
///
/// For little damping it satisfies the rows, and follows `preferred` in the directions that they leave free. Variables
/// at a bound that the step would cross are held, and the others are solved for again (damped_rows.h). Allocates no
/// memory after `resize` to the largest size.
class DampedStep {
 public:
  void resize(int rows, int columns);
  int rows() const { return rows_; }
  int columns() const { return columns_; }

  double* column(int c) { return J_.data() + std::ptrdiff_t(c) * rows_; }  ///< of J, filled by the caller
  const double* column(int c) const { return J_.data() + std::ptrdiff_t(c) * rows_; }
  double& error(int r) { return e_[r]; }
  double multiplier(int r) const { return y_[r]; }  ///< Lagrange multiplier of row r; 0 if the row is inactive

  /// Computes `step()`. If an entry exceeds its `longest`, all entries with a finite `longest` are scaled down.
  /// `preferred` may be null.
  void solve(const double* x, const double* lower, const double* upper, const double* longest, double damping,
             const double* preferred);
  const VectorXd& step() const { return step_; }

  /// Returns the damping for rows with this sum of squares.
  static double damping(double square);

 private:
  int rows_ = 0, columns_ = 0;
  std::vector<double> J_, A_, e_, y_, inverse_pivots_, keep_;
  VectorXd step_;
};

}  // namespace kinegraph::inline ik_internal
