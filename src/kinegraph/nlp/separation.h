#pragma once

#include <memory>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

class Nlp;

/// A problem whose sums of overlaps, phi = sum_i max(0, c_i), are separate inequalities c_i <= 0: it has the same
/// solutions, and a solver sees which terms are in trouble, and which soon will be. Variables and all other rows are
/// the same.
struct Separation {
  std::shared_ptr<Nlp> problem;  ///< null: there is nothing to separate
  std::vector<int> row_of;       ///< per row of `problem`: the row of the original that it belongs to
  std::vector<bool> is_term;     ///< per row of `problem`: a c_i

  /// Residuals of the original, with `rows` of them.
  VectorXd joined(const VectorXd& phi, Eigen::Index rows) const;

  /// Multipliers of the original: of a sum, the largest of its terms.
  VectorXd joinedDual(const VectorXd& dual, Eigen::Index rows) const;
};

}  // namespace kinegraph
