#pragma once

#include "kinegraph/komo/path/path.h"

namespace kinegraph::inline komo_internal {

/// One phase of a path with one slice per phase, as input for a motion planner.
struct SubProblem {
  Config config;  ///< scene at the beginning of the phase; only joints of the initial configuration are active
  VectorXd start, end;
};

/// Throws ValueError for paths with more slices per phase, and for phases that do not exist.
SubProblem subProblem(const Path& path, int phase);

}  // namespace kinegraph::inline komo_internal
