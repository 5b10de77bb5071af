#pragma once

#include <memory>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

class Nlp;

/// An equivalent form of a problem, in which separate inequalities c_i <= 0 replace sums phi = sum_i max(0, c_i). It
/// has the same solutions, and a solver sees each term and how close it is to its bound. Variables and all other
/// residuals are the same.
struct Separation {
  std::shared_ptr<Nlp> problem;  ///< null if there are no such sums
  std::vector<int> row_of;       ///< per residual of `problem`: the residual of the original that it belongs to
  std::vector<bool> is_term;     ///< per residual of `problem`: whether it is a c_i

  /// Returns the `rows` residuals of the original.
  VectorXd joined(const VectorXd& phi, Eigen::Index rows) const;

  /// Returns the multipliers of the original; that of a sum is the largest of its terms.
  VectorXd joinedDual(const VectorXd& dual, Eigen::Index rows) const;
};

}  // namespace kinegraph
