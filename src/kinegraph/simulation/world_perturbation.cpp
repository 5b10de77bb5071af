// The spring perturbation of a body.
#include <algorithm>

#include "kinegraph/simulation/world.h"

namespace kinegraph {

namespace {

constexpr double kPerturbationFrequency = 10.;  ///< rad/s

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

/// Adds the spring force f = m (w^2 (target - p) - 2 w dp/dt) to the forces on the body.
void World::addPerturbation() {
  const mjModel& m = *physics_;
  mjData& d = *data_;
  const int id = model_->body_id[std::size_t(perturbation_.body)];
  const Vector3d point = placed(d, id, perturbation_.point);
  const mjtNum* twist = d.cvel + 6 * id;
  const Vector3d velocity =
      Vector(twist + 3) + Vector(twist).cross(point - Vector(d.subtree_com + 3 * m.body_rootid[id]));
  const double w = kPerturbationFrequency;
  perturbation_force_ = m.body_subtreemass[id] * (w * w * (perturbation_.target - point) - 2. * w * velocity);
  Eigen::Map<Vector6d> applied(d.xfrc_applied + 6 * id);
  force_before_perturbation_ = applied;
  applied.head<3>() += perturbation_force_;
  applied.tail<3>() += (point - Vector(d.xipos + 3 * id)).cross(perturbation_force_);
}

void World::removePerturbation() {
  const int id = model_->body_id[std::size_t(perturbation_.body)];
  std::copy_n(force_before_perturbation_.data(), 6, data_->xfrc_applied + 6 * id);
}

}  // namespace kinegraph
