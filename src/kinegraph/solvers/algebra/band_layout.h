#pragma once

#include <vector>

#include "kinegraph/math/banded_matrix.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// Where each variable goes in a matrix J^T J, and how many are at its end: those that rows connect to others much
/// farther on than is usual (dofs that many slices of a path share). The matrix is then a band with a border, and its
/// factor has no other entries.
struct BandLayout {
  std::vector<int> place;  ///< of each variable
  int shared = 0;          ///< at the end
};
BandLayout bandLayout(int variables, const Jacobian& pattern);

/// A matrix of that layout, with room for the products of entries of the same row.
BandedMatrix bandedMatrix(const BandLayout& layout, const Jacobian& pattern);

}  // namespace kinegraph
