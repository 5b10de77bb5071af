#pragma once

#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// The step dx of a damped least squares problem within bounds, computed in the space of the rows, which are few:
///
///     min |J dx - e|^2 + damping |dx - pull|^2      lower <= x + dx <= upper
///
/// For little damping it meets the rows and moves as `pull` says where they leave freedom. Variables at a bound that
/// the step would cross are held, and the others solved for again. How it is computed is in damped_rows.h. Requests no
/// memory after `resize` to the largest size.
class DampedStep {
 public:
  void resize(int rows, int columns);
  int rows() const { return rows_; }
  int columns() const { return columns_; }

  double* column(int c) { return J_.data() + std::ptrdiff_t(c) * rows_; }  ///< of J, to be filled
  const double* column(int c) const { return J_.data() + std::ptrdiff_t(c) * rows_; }
  double& error(int r) { return e_[r]; }
  double multiplier(int r) const { return y_[r]; }  ///< what pulls at row r; 0 for a row that is met for free

  /// Computes `step()`. Where an entry exceeds its `longest`, all that have a finite one are scaled down. `pull` may be
  /// null.
  void solve(const double* x, const double* lower, const double* upper, const double* longest, double damping,
             const double* pull);
  const VectorXd& step() const { return step_; }

  /// The damping for rows whose sum of squares is `square`.
  static double damping(double square);

 private:
  int rows_ = 0, columns_ = 0;
  std::vector<double> J_, A_, e_, y_, inverse_pivots_, keep_;
  VectorXd step_;
};

}  // namespace kinegraph
