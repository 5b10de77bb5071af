#pragma once

#include <vector>

#include "kinegraph/math/banded_matrix.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline solvers_internal {

/// The order of variables in a matrix J^T J: a band followed by a border. The border holds variables that residuals
/// connect to unusually distant ones, such as dofs that many slices of a path share. The factor of the matrix has the
/// same pattern.
struct BandLayout {
  std::vector<int> place;  ///< index of each variable in the matrix
  int shared = 0;          ///< number of variables in the border
};
BandLayout bandLayout(int variables, const Jacobian& pattern);

/// Creates a matrix of that layout, with entries for all products within a residual.
BandedMatrix bandedMatrix(const BandLayout& layout, const Jacobian& pattern);

}  // namespace kinegraph::inline solvers_internal
