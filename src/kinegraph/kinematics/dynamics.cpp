#include "kinegraph/kinematics/dynamics.h"

#include "kinegraph/kinematics/spatial_motion.h"

namespace kinegraph {

namespace {

/// Velocities of all links, and accelerations for given ddq; the world accelerates against gravity.
struct LinkMotions {
  std::vector<Motion> velocity, acceleration;
};

/// `dq` and `ddq` have n numbers; `ddq` may be null.
void propagate(const State& state, const double* dq, const double* ddq, const Vector3d& gravity, LinkMotions& motions) {
  const KinematicModel& model = state.model();
  motions.velocity.assign(model.links.size(), Motion());
  motions.acceleration.assign(model.links.size(), Motion());
  motions.acceleration[0].linear = -gravity;
  for (std::size_t l = 1; l < model.links.size(); ++l) {
    const KinematicModel::Link& link = model.links[l];
    Motion V = motions.velocity[link.parent], A = motions.acceleration[link.parent];
    int index = link.first_column;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      Motion own;  // velocity that this step adds
      double norm_rate = 0., square = 0.;
      for (int k = 0; k < model.steps[s].dofs(); ++k, ++index) {
        const int dof = model.column_dof[index];
        own.add(dq[dof], column(state, index));
        if (ddq) A.add(ddq[dof], column(state, index));
        norm_rate += state.q()[dof] * dq[dof];
        square += state.q()[dof] * state.q()[dof];
      }
      A.add(1., carried(V, own));
      // For a quaternion, w = 2 vec(dq q*) / |q|^2 also changes with the norm.
      if (model.steps[s].dofs() > 1) A.add(-2. * norm_rate / std::max(square, 1e-100), own);
      V.add(1., own);
    }
    motions.velocity[l] = V;
    motions.acceleration[l] = A;
  }
}

void newtonEuler(const State& state, const std::vector<LinkInertia>& inertias, const double* dq, const double* ddq,
                 const Vector3d& gravity, Eigen::Ref<VectorXd> force) {
  thread_local LinkMotions motions;  // control loops request no memory
  thread_local std::vector<Wrench> wrench;
  const KinematicModel& model = state.model();
  propagate(state, dq, ddq, gravity, motions);
  wrench.assign(model.links.size(), Wrench());
  force.setZero();
  for (std::size_t l = model.links.size() - 1; l > 0; --l) {
    const KinematicModel::Link& link = model.links[l];
    const WorldInertia inertia(inertias[l], state.linkPose(int(l)));
    const Motion& V = motions.velocity[l];
    const Wrench rate = inertia.times(motions.acceleration[l]), momentum = inertia.times(V);
    wrench[l].linear += rate.linear + V.angular.cross(momentum.linear);
    wrench[l].angular += rate.angular + V.angular.cross(momentum.angular) + V.linear.cross(momentum.linear);
    const bool last = l + 1 == model.links.size();
    const int end = last ? int(model.column_dof.size()) : model.links[l + 1].first_column;
    for (int index = link.first_column; index < end; ++index) {
      force[model.column_dof[index]] += power(column(state, index), wrench[l]);
    }
    wrench[link.parent].linear += wrench[l].linear;
    wrench[link.parent].angular += wrench[l].angular;
  }
}

}  // namespace

void LinkInertia::add(const LinkInertia& part, const RigidTransform& X_LF) {
  if (part.mass == 0. && part.matrix.isZero(0.)) return;
  const double total = mass + part.mass;
  const Vector3d part_com = X_LF * part.com;
  const Vector3d common = total > 0. ? Vector3d((mass * com + part.mass * part_com) / total) : com;
  const auto about = [&](double m, const Vector3d& c) {  // parallel axis theorem
    const Vector3d r = c - common;
    return Matrix3d(m * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose()));
  };
  matrix += about(mass, com) + X_LF.R * part.matrix * X_LF.R.transpose() + about(part.mass, part_com);
  mass = total;
  com = common;
}

VectorXd kinematics_internal::inverseDynamics(const State& state, const std::vector<LinkInertia>& inertias,
                                              const VectorXd& velocity, const VectorXd& acceleration,
                                              const Vector3d& gravity) {
  VectorXd forces(state.model().dofs);
  newtonEuler(state, inertias, velocity.data(), acceleration.data(), gravity, forces);
  return forces;
}

void kinematics_internal::inverseDynamics(const State& state, const std::vector<LinkInertia>& inertias,
                                          const Eigen::Ref<const VectorXd>& velocity,
                                          const Eigen::Ref<const VectorXd>& acceleration, Eigen::Ref<VectorXd> forces,
                                          const Vector3d& gravity) {
  newtonEuler(state, inertias, velocity.data(), acceleration.data(), gravity, forces);
}

EquationOfMotion kinematics_internal::equationOfMotion(const State& state, const std::vector<LinkInertia>& inertias,
                                                       const VectorXd& velocity, const Vector3d& gravity) {
  const KinematicModel& model = state.model();
  EquationOfMotion equation{MatrixXd::Zero(model.dofs, model.dofs), VectorXd(model.dofs)};
  newtonEuler(state, inertias, velocity.data(), nullptr, gravity, equation.F);
  for (std::size_t l = 1; l < model.links.size(); ++l) {
    const WorldInertia inertia(inertias[l], state.linkPose(int(l)));
    if (inertia.mass == 0. && inertia.matrix.isZero(0.)) continue;
    for (int c = model.last_column[l]; c >= 0; c = model.column_before[c]) {
      const Wrench momentum = inertia.times(column(state, c));
      for (int d = model.last_column[l]; d >= 0; d = model.column_before[d]) {
        equation.M(model.column_dof[c], model.column_dof[d]) += power(column(state, d), momentum);
      }
    }
  }
  return equation;
}

std::pair<double, Vector3d> kinematics_internal::centerOfMass(const State& state,
                                                              const std::vector<LinkInertia>& inertias) {
  double mass = 0.;
  Vector3d moment = Vector3d::Zero();
  for (std::size_t l = 1; l < inertias.size(); ++l) {
    mass += inertias[l].mass;
    moment += inertias[l].mass * (state.linkPose(int(l)) * inertias[l].com);
  }
  return {mass, mass > 0. ? Vector3d(moment / mass) : moment};
}

double kinematics_internal::kineticEnergy(const State& state, const std::vector<LinkInertia>& inertias,
                                          const VectorXd& velocity) {
  LinkMotions motions;
  propagate(state, velocity.data(), nullptr, Vector3d::Zero(), motions);
  double twice = 0.;
  for (std::size_t l = 1; l < inertias.size(); ++l) {
    twice += power(motions.velocity[l], WorldInertia(inertias[l], state.linkPose(int(l))).times(motions.velocity[l]));
  }
  return .5 * twice;
}

double kinematics_internal::potentialEnergy(const State& state, const std::vector<LinkInertia>& inertias,
                                            const Vector3d& gravity) {
  const auto [mass, com] = centerOfMass(state, inertias);
  return -mass * gravity.dot(com);
}

}  // namespace kinegraph
