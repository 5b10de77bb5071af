#pragma once

#include <set>
#include <vector>

#include "kinegraph/kinematics/state.h"
#include "kinegraph/komo/path/modes.h"

namespace kinegraph {

/// Where the dofs of the slices are in x. Slices follow one another, and within a slice the order is that of its q.
/// Dofs that several slices share are in x once, at the first slice that has them. Index 0 is the first slice before
/// the start.
struct PathLayout {
  int dimension = 0;
  bool plain = true;                     ///< x is just the q of the slices from 0 on, one after the other
  std::vector<std::vector<int>> column;  ///< per slice and dof; -1: constant
  std::vector<std::vector<KinematicModel::DofRange>> owned;  ///< per slice: its dofs that are in x at this slice
  VectorXd lower, upper;                                     ///< per entry of x
};

/// `prefix` is the number of slices before the start; `stable` the frames whose original joints are shared by all slices.
PathLayout makeLayout(const std::vector<State>& states, int prefix, const std::set<int>& stable, const Modes& modes);

}  // namespace kinegraph
