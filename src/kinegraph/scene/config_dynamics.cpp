#include "kinegraph/scene/dynamics.h"

#include "kinegraph/kinematics/state.h"
#include "kinegraph/kinematics/velocity_dynamics.h"

namespace kinegraph {

int velocityDimension(const Config& config) { return velocityDimension(config.state().model()); }

MatrixXd velocityMap(const Config& config) { return velocityMap(config.state()); }

RigidBodyDynamics rigidBodyDynamics(const Config& config, const VectorXd& v, const Vector3d& gravity) {
  return rigidBodyDynamics(config.state(), config.inertias(), v, gravity);
}

MatrixXd centroidalMomentumMatrix(const Config& config) {
  return centroidalMomentumMatrix(config.state(), config.inertias());
}

}  // namespace kinegraph
