#pragma once

namespace kinegraph {

/// What is special in a constant rotation R that is multiplied from the right: most are identities or of quarter turns,
/// where column k of the product is sign[k] times column[k] of the left factor.
struct ConstantRotation {
  enum Kind : unsigned char { none, quarters, general };
  Kind kind = none;
  unsigned char column[3] = {0, 1, 2};
  double sign[3] = {1., 1., 1.};
};

/// Of a rotation given by its columns. What misses a quarter turn by rounding (1e-15) counts as one.
ConstantRotation classifyRotation(const double* R);

}  // namespace kinegraph
