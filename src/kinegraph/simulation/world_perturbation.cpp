// The spring perturbation of a body.
#include <Eigen/Eigenvalues>
#include <algorithm>

#include "kinegraph/simulation/physics.h"
#include "kinegraph/simulation/world.h"

namespace kinegraph::inline simulation_internal {

namespace {

constexpr double kPerturbationFrequency = 10.;  ///< rad/s
constexpr double kFarthest = .3;                ///< m: a target farther away pulls as from there, with at most 30 m/s^2
constexpr double kMostOfPointMass = 10.;  ///< largest mass of the spring over the inertia that the point resists with

using Vector = Eigen::Map<const Vector3d>;

/// Returns a point of a body in the world, by MuJoCo's present positions.
Vector3d placed(const mjData& d, int id, const Vector3d& point) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> axes(d.xmat + 9 * id);
  return Vector(d.xpos + 3 * id) + axes * point;
}

}  // namespace

void World::perturb(const PerturbationSpring& spring) {
  perturbation_ = spring;
  perturbation_force_.setZero();
}

Vector3d World::perturbedPoint() const {
  const Pose X_WB = bodyPose(perturbation_.body);
  return X_WB.p + X_WB.q * perturbation_.point;
}

bool World::canMove(int body) const {
  const std::vector<SceneBody>& bodies = model_->scene.bodies;
  while (bodies[std::size_t(body)].kind == SceneBody::Kind::fixed) body = bodies[std::size_t(body)].parent;
  return bodies[std::size_t(body)].kind != SceneBody::Kind::world;
}

/// Returns the least inertia that a point resists with, kg, over all directions of a force: 1 / |J M^-1 J^T|.
double World::inertiaAt(const Vector3d& point, int body) {
  const int n = physics_->nv;
  point_jacobian_.resize(std::size_t(3 * n));
  point_response_.resize(std::size_t(3 * n));
  physics().mj_jac(&*physics_, &*data_, point_jacobian_.data(), nullptr, point.data(), body);
  physics().mj_solveM(&*physics_, &*data_, point_response_.data(), point_jacobian_.data(), 3);
  using Rows = Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>>;
  const Matrix3d response = Rows(point_response_.data(), 3, n) * Rows(point_jacobian_.data(), 3, n).transpose();
  return 1. / std::max(Eigen::SelfAdjointEigenSolver<Matrix3d>()
                           .computeDirect(response, Eigen::EigenvaluesOnly)
                           .eigenvalues()
                           .maxCoeff(),
                       1e-9);
}

/// Adds the spring force f = m (w^2 (target - p) - 2 w dp/dt) to the forces on the body. A point far off the body, and
/// a target far away, pull less: otherwise the spring would be too stiff for the body's small rotational inertia.
void World::addPerturbation() {
  const mjModel& m = *physics_;
  mjData& d = *data_;
  const int id = model_->body_id[std::size_t(perturbation_.body)];
  const Vector3d point = placed(d, id, perturbation_.point);
  const mjtNum* twist = d.cvel + 6 * id;
  const Vector3d velocity =
      Vector(twist + 3) + Vector(twist).cross(point - Vector(d.subtree_com + 3 * m.body_rootid[id]));
  const double w = kPerturbationFrequency;
  const double mass = std::min(m.body_subtreemass[id], kMostOfPointMass * inertiaAt(point, id));
  const Vector3d offset = perturbation_.target - point;
  const Vector3d towards = offset * std::min(1., kFarthest / std::max(offset.norm(), kFarthest));
  perturbation_force_ = mass * (w * w * towards - 2. * w * velocity);
  const double most = 2. * mass * w * w * kFarthest;  // the damping of fast points, with an explicit step
  perturbation_force_ *= std::min(1., most / std::max(perturbation_force_.norm(), most));
  Eigen::Map<Vector6d> applied(d.xfrc_applied + 6 * id);
  force_before_perturbation_ = applied;
  applied.head<3>() += perturbation_force_;
  applied.tail<3>() += (point - Vector(d.xipos + 3 * id)).cross(perturbation_force_);
}

void World::removePerturbation() {
  const int id = model_->body_id[std::size_t(perturbation_.body)];
  std::copy_n(force_before_perturbation_.data(), 6, data_->xfrc_applied + 6 * id);
}

}  // namespace kinegraph::inline simulation_internal
