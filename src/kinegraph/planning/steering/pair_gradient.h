#pragma once

#include "kinegraph/kinematics/state.h"

namespace kinegraph::inline planning_internal {

/// The distance of two bodies and its gradient.
struct PairGradient {
  double distance;    ///< m, negative if they overlap
  VectorXd gradient;  ///< (dofs), m per rad or m
};

/// Computes the distance of two frames (ids) with bodies, at the q of a State.
PairGradient pairGradient(const State& state, int a, int b);

}  // namespace kinegraph::inline planning_internal
