#pragma once

#include <vector>

#include "kinegraph/kinematics/joint.h"

namespace kinegraph::inline kinematics_internal {

class State;
struct KinematicModel;

/// Returns the number nv of velocities.
int velocityDimension(const KinematicModel& model);

/// Returns T(q). Motion along it preserves the norms of quaternions.
MatrixXd velocityMap(const State& state);

/// Computes M, C (from Christoffel symbols) and g. Throws ValueError unless `v` has velocityDimension entries.
/// Source: Echeandia & Wensing, Numerical methods to compute the Coriolis matrix and Christoffel symbols, 2021.
RigidBodyDynamics rigidBodyDynamics(const State& state, const std::vector<LinkInertia>& inertias, const VectorXd& v,
                                    const Vector3d& gravity = kGravity);

/// Computes A, 6 x nv. The momentum of everything that moves is A v: first the linear one, kg m/s, then the angular one
/// about the common center of mass, kg m^2/s, in the axes of the world.
/// Source: Orin, Goswami & Lee, Centroidal dynamics of a humanoid robot, 2013.
MatrixXd centroidalMomentumMatrix(const State& state, const std::vector<LinkInertia>& inertias);

}  // namespace kinegraph::inline kinematics_internal
