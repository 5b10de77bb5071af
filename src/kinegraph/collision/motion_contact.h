#pragma once

namespace kinegraph {

/// The first contact of an edge: a pair that comes too close, or a dof that leaves its limits.
struct MotionContact {
  double time = 0.;      ///< in [0, 1]: until then the edge is free
  int a = 0, b = 0;      ///< frame ids; for a limit, both are the joint's
  double distance = 0.;  ///< of the pair at `time`, m; for a limit: the distance to it, m or rad
  int dof = -1;          ///< for a limit: the entry of q; else -1
};

}  // namespace kinegraph
