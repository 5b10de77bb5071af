#pragma once

#include <vector>

#include "bindings.h"
#include "kinegraph/ik/solve_ik.h"

namespace kinegraph::python {

/// What `solveIk` is asked for: one problem, or one per row of the arrays among the targets.
struct IkRequest {
  std::vector<std::vector<IkTarget>> problems;
  bool is_batch = false;
};

/// Reads a dict from frames (names or Frame) to what they are to do: a position (3,), a pose (7,) or (4, 4), rows of
/// them (N, 3), (N, 7), (N, 4, 4), the name of a frame or a Frame whose pose it is, or a dict with `position`, `pose`,
/// `quaternion`, `x`, `y`, `z` (directions of the frame's axes), `gaze` with its `axis`, and `relativeTo`; and from
/// features (FS, or a tuple of FS and frames) to their values. Throws ValueError and FrameNotFound.
IkRequest readIkTargets(const Config& config, nb::handle targets);

}  // namespace kinegraph::python
