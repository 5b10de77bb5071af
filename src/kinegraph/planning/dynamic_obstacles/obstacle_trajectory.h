#pragma once

#include <string>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// The known trajectory of a dynamic obstacle: a frame of the scene with its subtree. Values are interpolated linearly
/// (quaternions along the shorter arc, normalized) and constant before the first and after the last time. The frame is
/// independent of q.
struct ObstacleTrajectory {
  std::string frame;
  VectorXd times;  ///< (K,), increasing, s

  /// (K, 7): poses in the world, x y z qw qx qy qz, m; or (K, d): positions of the frame's joint of d dofs.
  MatrixXd values;
};

}  // namespace kinegraph
