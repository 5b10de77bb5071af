#pragma once

#include "kinegraph/komo/path/path.h"

namespace kinegraph {

/// One phase of a path with one slice per phase, to be planned in detail.
struct SubProblem {
  Config config;  ///< as it is at the beginning of the phase, only the given configuration's joints active
  VectorXd start, end;
};

/// Throws ValueError for paths with more slices per phase, and for phases that are not there.
SubProblem subProblem(const Path& path, int phase);

}  // namespace kinegraph
