#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "kinegraph/math/pose.h"
#include "kinegraph/planning/motion_plan.h"
#include "kinegraph/trajectories/retime.h"

namespace kinegraph::inline tool_paths_internal {

inline constexpr double kSameConfiguration = 1e-6;  // rad or m: no transfer between two configurations

/// A way to do a path: a solution in one direction, with its first and last configuration.
struct PathVariant {
  int solution = 0;
  bool reversed = false;
  VectorXd first, last;
  double duration = 0.;  ///< s, of the path itself; only differences count
};

/// Paths to be ordered, and how long transfers between their variants take. Variants are counted over all paths.
struct OrderProblem {
  std::vector<std::vector<PathVariant>> variants;  ///< per path, at least one each
  bool free_order = false;
  MatrixXd transfer;            ///< (m, m): s, from the end of a variant to the start of another one
  VectorXd begin;               ///< (m,): s, from where the robot is
  std::vector<int> near_order;  ///< an order to be improved; empty: orders of nearest neighbors
};

struct OrderedPath {
  int path = 0, solution = 0;
  bool reversed = false;
  int variant = 0;
};

/// Orders paths so that they and the transfers between them are short, and chooses a variant of each. The choice of
/// variants is the best one for an order (dynamic programming). Orders are improved from the nearest neighbors by
/// reversing and moving parts.
std::vector<OrderedPath> orderPaths(const OrderProblem& problem);

/// The least duration of a motion from rest to rest, s: each joint alone within its limits.
double leastTransfer(const VectorXd& from, const VectorXd& to, const MotionLimits& limits);

/// Paths in their order, with the transfer that leads to each of them.
struct PathSequence {
  std::vector<OrderedPath> order;
  std::vector<std::optional<MotionPlan>> transfers;  ///< none: the robot is there
  bool feasible = false;                             ///< false: a transfer of each order that was tried is not feasible
};

/// Plans a transfer between two configurations with a small budget.
using TransferPlanner = std::function<MotionPlan(const VectorXd& from, const VectorXd& to)>;

/// Orders paths by their durations and those of planned transfers. The transfers of the given order are planned, then
/// those of the best order by least durations; where they take longer, or do not exist, the order is looked for again,
/// until its transfers are all planned. `from` is where the motion begins; none: at the first path.
PathSequence orderWithTransfers(std::vector<std::vector<PathVariant>> variants, bool free_order,
                                const std::optional<VectorXd>& from, const MotionLimits& limits,
                                const TransferPlanner& plan);

}  // namespace kinegraph::inline tool_paths_internal
