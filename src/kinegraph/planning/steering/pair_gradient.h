#pragma once

#include "kinegraph/kinematics/state.h"

namespace kinegraph {

/// How far two bodies are apart, and how that changes with q.
struct PairGradient {
  double distance;    ///< m, negative where they overlap
  VectorXd gradient;  ///< (dofs), m per rad or m
};

/// Of two frames (ids) with bodies, at the q of a State.
PairGradient pairGradient(const State& state, int a, int b);

}  // namespace kinegraph
