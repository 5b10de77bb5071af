#pragma once

#include <set>
#include <vector>

#include "kinegraph/kinematics/state.h"
#include "kinegraph/komo/path/modes.h"

namespace kinegraph::inline komo_internal {

/// Positions of the dofs of the slices in x. Slices follow one another, and dofs of a slice are in the order of its q.
/// Shared dofs occur once, at the first slice that has them. Index 0 is the first slice before the start.
struct PathLayout {
  int dimension = 0;
  bool plain = true;                     ///< x is the concatenation of the q of the slices from 0 on
  std::vector<std::vector<int>> column;  ///< per slice and dof; -1 for constants
  std::vector<std::vector<KinematicModel::DofRange>> owned;  ///< per slice: its dofs whose entries of x belong to this
                                                             ///< slice
  VectorXd lower, upper;                                     ///< per entry of x
};

/// Computes the layout. `prefix` is the number of slices before the start; `stable` contains the frames whose original
/// joints are shared by all slices.
PathLayout makeLayout(const std::vector<State>& states, int prefix, const std::set<int>& stable, const Modes& modes);

}  // namespace kinegraph::inline komo_internal
