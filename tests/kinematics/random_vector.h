#pragma once

#include "kinegraph/common/random.h"
#include "kinegraph/math/pose.h"

namespace kinegraph {

/// Normally distributed.
inline VectorXd randomVector(int n, Rng& rng) {
  VectorXd v(n);
  for (double& entry : v) entry = rng.normal();
  return v;
}

}  // namespace kinegraph
