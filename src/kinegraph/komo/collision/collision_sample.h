#pragma once

namespace kinegraph {

/// An instant of a motion between slices at which two shapes count; or room for one.
struct CollisionSample {
  double share = 0.;   ///< of the way, in [0, 1]
  int a = -1, b = -1;  ///< frames; -1: there is none yet

  bool isEmpty() const { return a < 0; }
};

}  // namespace kinegraph
