#pragma once

#include <vector>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/common/random.h"

namespace kinegraph::inline komo_internal {

/// The dofs in which a path may leave the straight edge, and their bounds.
struct SampleBounds {
  std::vector<int> dofs;
  VectorXd lower, upper;  ///< finite, per entry of `dofs`
};

/// Finds a path between two configurations by RRT-Connect and shortcuts it. Its edges keep the checker's margin
/// continuously. Empty if `max_samples` samples find none, if an end is in collision, or if the ends differ in a dof
/// that is not in `bounds`.
std::vector<VectorXd> rrtPath(EdgeChecker& checker, const SampleBounds& bounds, const VectorXd& from,
                              const VectorXd& to, Rng& rng, int max_samples);

}  // namespace kinegraph::inline komo_internal
