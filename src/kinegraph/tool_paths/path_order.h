#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// A way to do a path: a solution in one direction, with its first and last configuration.
struct PathVariant {
  int solution = 0;
  bool reversed = false;
  VectorXd first, last;
};

struct OrderProblem {
  std::vector<std::vector<PathVariant>> variants;  ///< per path, at least one each
  VectorXd velocity;                               ///< limits of the joints; transfers take max |dq / velocity|
  bool free_order = false;
  std::optional<VectorXd> from = {};  ///< where the motion begins
  std::uint64_t seed = 0;
};

struct OrderedPath {
  int path = 0, solution = 0;
  bool reversed = false;
};

/// Orders paths so that the transfers between them are short, and chooses a variant of each. The choice of variants is
/// the best one for an order (dynamic programming). Orders are improved from the nearest neighbors by reversing and
/// moving parts.
std::vector<OrderedPath> orderPaths(const OrderProblem& problem);

}  // namespace kinegraph
