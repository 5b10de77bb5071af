#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/search/path_search.h"

namespace kinegraph::inline planning_internal {

struct RopeShortcutOptions {
  VectorXd weight = {};  ///< per dof, of the weighted length; empty: ones
  int rounds = 20;       ///< maximum
  int refinements = 2;   ///< halvings of the pieces in contact: a shorter path with more corners
  CancellationToken cancellation = {};
};

/// Tightens a path like a rope around the obstacles that it touches. The result is shorter, has the same ends, and is
/// continuously collision-free, as the path itself must be. Constrained paths are returned unchanged.
///
/// The path is divided into pieces of lengths h_i. Each iteration minimizes the sum of |x_i+1 - x_i|^2 / h_i over all
/// paths x_0 ... x_K, subject to linearized distances of the pairs in contact. A step of adaptive length towards the
/// minimum is checked continuously. A pair in collision becomes a constraint row, linearized where the pair is closest,
/// and the problem is solved again. Without rows the minimum is the straight line. A row acts as a force at one place,
/// and the response of the other points is known in closed form, so that only the forces >= 0 are unknown. Around a
/// corner the path is a polygon; a refinement halves its sides.
std::vector<VectorXd> tightenPath(Steering& steering, const std::vector<VectorXd>& path,
                                  const RopeShortcutOptions& options = {});

}  // namespace kinegraph::inline planning_internal
