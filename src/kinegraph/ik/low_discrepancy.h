#pragma once

#include <cmath>
#include <cstdint>

#include "kinegraph/common/random.h"
#include "kinegraph/math/pose.h"

namespace kinegraph::inline ik_internal {

/// A sequence of points whose every prefix fills the unit cube evenly: x_i = frac(shift + i a), with a_k = phi^-k and
/// phi the root of phi^(d+1) = phi + 1.
class LowDiscrepancy {
 public:
  LowDiscrepancy(int dimension, std::uint64_t seed) : step_(dimension), shift_(dimension) {
    double phi = 2.;
    for (double before = 0.; dimension > 0 && std::abs(phi - before) > 1e-15;) {  // there is no root without dimensions
      before = phi;
      phi = std::pow(1. + phi, 1. / (dimension + 1.));
    }
    Rng rng(seed);
    double power = 1.;
    for (int k = 0; k < dimension; ++k) {
      step_[k] = power /= phi;
      shift_[k] = rng.uniform();
    }
  }

  /// Returns coordinate k of point i, in [0, 1).
  double at(int i, int k) const {
    const double x = shift_[k] + i * step_[k];
    return x - std::floor(x);
  }

 private:
  VectorXd step_, shift_;
};

}  // namespace kinegraph::inline ik_internal
