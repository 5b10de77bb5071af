#pragma once

#include <memory>
#include <string>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// The state of a simulation. Fields may be changed before it is restored.
struct SimulationState {
  double time = 0.;       ///< s
  VectorXd q, qDot;       ///< of the Config's active joints
  MatrixXd freePos;       ///< F x 7, world poses of the free frames: x y z qw qx qy qz
  MatrixXd freeVel;       ///< F x 6, linear (m/s) and angular (rad/s) velocities, world
  std::string remainder;  ///< everything else that affects later steps, as bytes

  bool operator==(const SimulationState&) const = default;
};

}  // namespace kinegraph
