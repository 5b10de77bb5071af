#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/search/path_search.h"

namespace kinegraph {

struct RopeShortcutOptions {
  VectorXd weight = {};  ///< per dof, what length means; empty: ones
  int rounds = 20;       ///< at most
  int refinements = 2;   ///< of pieces that touch something: a shorter path, with more corners
  CancellationToken cancellation = {};
};

/// Pulls a path taut, as a string that is drawn around the obstacles that it touches: shorter, with the same ends, and
/// free at all times as the path itself is. Where there are constraints, the path is returned as it is.
///
/// The path is divided into pieces of lengths h_i. Of all paths x_0 ... x_K the sum of |x_i+1 - x_i|^2 / h_i is
/// made least, while the distances of pairs that were met, linearized, stay large enough. A step towards that path, of a
/// length that is learnt, is checked at all times. What it meets is linearized where the pair is nearest, and it is solved
/// again. Without such rows the answer is the straight line; each row pulls at one place, and how far the others follow is
/// known in closed form. So only the pulls are unknown, few numbers >= 0. Around a corner the path is a polygon: a
/// refinement halves its sides and pulls again.
std::vector<VectorXd> tightenPath(Steering& steering, const std::vector<VectorXd>& path,
                                  const RopeShortcutOptions& options = {});

}  // namespace kinegraph
