#pragma once

#include <vector>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// Estimates of the second derivatives of constraints, one matrix each, from how their gradients change. They are
/// symmetric and may be indefinite, as the truth; those of linear rows stay zero, and those of quadratic rows are exact
/// after n independent steps, whatever the multipliers are.
/// Source: Nocedal & Wright, Numerical Optimization, 2nd ed., ch. 6.2 (SR1).
class ConstraintCurvature {
 public:
  static constexpr double kMostEntries = 4e6;  ///< of all matrices; a larger problem is none for this

  static bool canHold(std::size_t rows, int n) { return double(rows) * n * n <= kMostEntries; }

  /// Forgets everything. `rows` are those of the Jacobian.
  void reset(const std::vector<int>& rows, int n);

  /// The Jacobian was `before`, and is `after` after the step `s`.
  void update(const VectorXd& s, const Jacobian& before, const Jacobian& after);

  /// H += sum_j multipliers_j B_j
  void addTo(MatrixXd& H, const VectorXd& multipliers) const;

  /// Rows that are orthogonal to the directions along which curved constraints with a multiplier were never seen; none
  /// if all of them look linear.
  MatrixXd seen(const VectorXd& multipliers) const;

 private:
  std::vector<int> rows_;
  std::vector<MatrixXd> B_;  ///< empty where nothing but zero was seen
  VectorXd r_;
};

}  // namespace kinegraph
