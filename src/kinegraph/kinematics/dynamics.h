#pragma once

#include <vector>

#include "kinegraph/kinematics/joint.h"
#include "kinegraph/kinematics/state.h"

namespace kinegraph::inline kinematics_internal {

/// Computes both terms at the state's q and the velocity dq. Redundant dofs (the norm of a quaternion) have no inertia.
EquationOfMotion equationOfMotion(const State& state, const std::vector<LinkInertia>& inertias,
                                  const VectorXd& velocity, const Vector3d& gravity = kGravity);

/// Computes the generalized forces for the acceleration ddq by recursive Newton-Euler, linear in the number of links.
VectorXd inverseDynamics(const State& state, const std::vector<LinkInertia>& inertias, const VectorXd& velocity,
                         const VectorXd& acceleration, const Vector3d& gravity = kGravity);

/// Writes the same forces into `forces` (n,), without memory from the heap after the first call of a thread.
void inverseDynamics(const State& state, const std::vector<LinkInertia>& inertias,
                     const Eigen::Ref<const VectorXd>& velocity, const Eigen::Ref<const VectorXd>& acceleration,
                     Eigen::Ref<VectorXd> forces, const Vector3d& gravity = kGravity);

/// Returns the total mass of all moving links, and their center of mass in world coordinates.
std::pair<double, Vector3d> centerOfMass(const State& state, const std::vector<LinkInertia>& inertias);

/// Compute kinetic and potential energy, J; the potential is 0 at the world's origin.
double kineticEnergy(const State& state, const std::vector<LinkInertia>& inertias, const VectorXd& velocity);
double potentialEnergy(const State& state, const std::vector<LinkInertia>& inertias,
                       const Vector3d& gravity = kGravity);

/// Returns the center of mass of a single frame, in world coordinates, m.
inline Vector3d frameCenterOfMass(const State& state, int frame) {
  return state.pose(frame) * state.parameters().frame_mass[frame].com;
}

}  // namespace kinegraph::inline kinematics_internal
