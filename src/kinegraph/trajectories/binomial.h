#pragma once

namespace kinegraph::inline trajectories_internal {

/// Returns the binomial coefficient n over k; 0 outside of 0 <= k <= n.
inline double binomial(int n, int k) {
  if (k < 0 || k > n) return 0.;
  double value = 1.;
  for (int i = 0; i < k; ++i) value = value * (n - i) / (i + 1);
  return value;
}

}  // namespace kinegraph::inline trajectories_internal
