#pragma once

namespace kinegraph::inline kinematics_internal {

/// Structure of a constant rotation R that is multiplied from the right. Most are identities or quarter rotations; then
/// column k of the product is sign[k] times column[k] of the left factor.
struct ConstantRotation {
  enum Kind : unsigned char { none, quarters, general };
  Kind kind = none;
  unsigned char column[3] = {0, 1, 2};
  double sign[3] = {1., 1., 1.};
};

/// Classifies a rotation given by its columns. Deviations up to rounding (1e-15) from a quarter rotation are ignored.
ConstantRotation classifyRotation(const double* R);

}  // namespace kinegraph::inline kinematics_internal
