#pragma once

#include <vector>

#include "kinegraph/kinematics/state.h"

namespace kinegraph {

/// What a link weighs. Link 0 is the world; what it weighs never moves.
struct LinkInertia {
  double mass = 0.;                    ///< kg
  Vector3d com = Vector3d::Zero();     ///< center of mass in the link, m
  Matrix3d matrix = Matrix3d::Zero();  ///< about the center of mass, in the link's axes, kg m^2

  /// The two together, rigidly joined; `X_LF` places `part` in the link.
  void add(const LinkInertia& part, const RigidTransform& X_LF);
};

inline const Vector3d kGravity{0., 0., -9.81};  ///< m/s^2

/// The equation of motion u = M(q) ddq + F(q, dq), with generalized forces u (N m, N).
struct EquationOfMotion {
  MatrixXd M;  ///< n x n
  VectorXd F;  ///< n: Coriolis, centrifugal and gravity terms
};

/// Both terms at the state's q and the velocity dq. Redundant dofs (the norm of a quaternion) carry no inertia.
EquationOfMotion equationOfMotion(const State& state, const std::vector<LinkInertia>& inertias,
                                  const VectorXd& velocity, const Vector3d& gravity = kGravity);

/// Generalized forces that give the acceleration ddq: recursive Newton-Euler, linear in the number of links.
/// Source: Featherstone, Rigid Body Dynamics Algorithms, ch. 5, in world coordinates.
VectorXd inverseDynamics(const State& state, const std::vector<LinkInertia>& inertias, const VectorXd& velocity,
                         const VectorXd& acceleration, const Vector3d& gravity = kGravity);

/// The common center of mass of all moving links, in world coordinates; its mass beside it.
std::pair<double, Vector3d> centerOfMass(const State& state, const std::vector<LinkInertia>& inertias);

/// Kinetic and potential energy, J; the potential is 0 at the world's origin.
double kineticEnergy(const State& state, const std::vector<LinkInertia>& inertias, const VectorXd& velocity);
double potentialEnergy(const State& state, const std::vector<LinkInertia>& inertias,
                       const Vector3d& gravity = kGravity);

/// Center of the mass of one frame alone, in world coordinates, m.
inline Vector3d frameCenterOfMass(const State& state, int frame) {
  return state.pose(frame) * state.parameters().frame_mass[frame].com;
}

}  // namespace kinegraph
