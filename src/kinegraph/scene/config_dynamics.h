#pragma once

#include "kinegraph/kinematics/velocity_dynamics.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

// Dynamics of a scene in velocity coordinates at its current q; see kinematics/velocity_dynamics.h.

inline int velocityDimension(const Config& config) { return velocityDimension(config.state().model()); }

inline MatrixXd velocityMap(const Config& config) { return velocityMap(config.state()); }

inline RigidBodyDynamics rigidBodyDynamics(const Config& config, const VectorXd& v,
                                           const Vector3d& gravity = kGravity) {
  return rigidBodyDynamics(config.state(), config.inertias(), v, gravity);
}

inline MatrixXd centroidalMomentumMatrix(const Config& config) {
  return centroidalMomentumMatrix(config.state(), config.inertias());
}

}  // namespace kinegraph
