#pragma once

#include <vector>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/common/random.h"

namespace kinegraph {

/// Of the configurations between which a way is looked for: the dofs that may move, and where these are drawn from.
struct TreeBounds {
  std::vector<int> dofs;
  VectorXd lower, upper;  ///< finite, per entry of `dofs`
};

/// Configurations from one to another; the straight motions between them are free at all times, by what the checker
/// keeps. Two trees grow towards each other, by at most `growths` drawn configurations; what they find is shortened. Empty
/// if they do not meet, or if `from` and `to` differ in a dof that may not move.
/// Source: Kuffner, LaValle, RRT-Connect, 2000.
std::vector<VectorXd> treePath(EdgeChecker& checker, const TreeBounds& room, const VectorXd& from, const VectorXd& to,
                               Rng& rng, int growths);

}  // namespace kinegraph
