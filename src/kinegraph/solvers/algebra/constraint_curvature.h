#pragma once

#include <vector>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline solvers_internal {

/// Estimates the second derivatives of constraints from changes of their gradients (SR1), one matrix per constraint.
/// The estimates are symmetric and may be indefinite. They stay zero for linear constraints and are exact for quadratic
/// ones after n independent steps, for any multipliers.
/// Source: Nocedal & Wright, Numerical Optimization, 2nd ed., ch. 6.2 (SR1).
class ConstraintCurvature {
 public:
  static constexpr double kMaxEntries = 4e6;  ///< limit on the entries of all matrices

  static bool canHold(std::size_t rows, int n) { return double(rows) * n * n <= kMaxEntries; }

  /// Resets all estimates. `rows` are indices of the Jacobian.
  void reset(const std::vector<int>& rows, int n);

  /// Updates the estimates from the Jacobians before and after the step `s`.
  void update(const VectorXd& s, const Jacobian& before, const Jacobian& after);

  /// H += sum_j multipliers_j B_j
  void addTo(MatrixXd& H, const VectorXd& multipliers) const;

  /// Returns rows that span the directions in which the curvature of constraints with multipliers was observed; none if
  /// no curvature was observed.
  MatrixXd observed(const VectorXd& multipliers) const;

 private:
  std::vector<int> rows_;
  std::vector<MatrixXd> B_;  ///< empty for constraints without observed curvature
  VectorXd r_;
};

}  // namespace kinegraph::inline solvers_internal
