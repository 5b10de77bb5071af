#pragma once

namespace kinegraph::inline komo_internal {

/// A time of a motion between slices at which the distance of a pair is constrained; or an empty placeholder.
struct CollisionSample {
  double time = 0.;    ///< fraction of the motion, in [0, 1]
  int a = -1, b = -1;  ///< ids of frames; -1 for an empty sample

  bool isEmpty() const { return a < 0; }
};

}  // namespace kinegraph::inline komo_internal
