#pragma once

#include "kinegraph/kinematics/inertia.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

// Dynamics of a scene in velocity coordinates at its current q; see kinematics/velocity_dynamics.h.

int velocityDimension(const Config& config);

MatrixXd velocityMap(const Config& config);

RigidBodyDynamics rigidBodyDynamics(const Config& config, const VectorXd& v, const Vector3d& gravity = kGravity);

MatrixXd centroidalMomentumMatrix(const Config& config);

}  // namespace kinegraph
