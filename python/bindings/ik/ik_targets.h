#pragma once

#include <vector>

#include "bindings.h"
#include "kinegraph/ik/solve_ik.h"

namespace kinegraph::python {

/// The problems of a `solveIk` call: one, or one per row of the arrays among the targets.
struct IkProblems {
  std::vector<std::vector<IkTarget>> problems;
  bool is_batch = false;
};

/// Reads a dict from frames (names or Frame) to targets, and from features (FS, or a tuple of FS and frames) to values.
/// A target is a position (3,), a pose (7,) or (4, 4), rows of them (N, 3), (N, 7), (N, 4, 4), or the name of a frame
/// or a Frame with the desired pose. Or it is a dict with `position`, `pose`, `quaternion`, `x`, `y`, `z` (directions
/// of the frame's axes), `gaze` with its `axis`, and `relativeTo`. Throws ValueError and FrameNotFound.
IkProblems readIkTargets(const Config& config, nb::handle targets);

}  // namespace kinegraph::python
