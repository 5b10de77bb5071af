// A body that is pulled by a spring.
#include <algorithm>

#include "kinegraph/simulation/world.h"

namespace kinegraph {

namespace {

constexpr double kPullFrequency = 10.;  ///< rad/s

using Vector = Eigen::Map<const Vector3d>;

/// Where a point of a body is, world, as MuJoCo has it now.
Vector3d placed(const mjData& d, int id, const Vector3d& point) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> axes(d.xmat + 9 * id);
  return Vector(d.xpos + 3 * id) + axes * point;
}

}  // namespace

void World::pull(const Pull& pull) {
  pull_ = pull;
  pull_force_.setZero();
}

Vector3d World::pulledPoint() const {
  const Pose X_WB = bodyPose(pull_.body);
  return X_WB.p + X_WB.q * pull_.point;
}

bool World::canMove(int body) const {
  const std::vector<SceneBody>& bodies = model_->scene.bodies;
  while (bodies[std::size_t(body)].kind == SceneBody::Kind::fixed) body = bodies[std::size_t(body)].parent;
  return bodies[std::size_t(body)].kind != SceneBody::Kind::world;
}

/// f = m (w^2 (target - p) - 2 w dp/dt), beside what pushes the body already.
void World::addPull() {
  const mjModel& m = *physics_;
  mjData& d = *data_;
  const int id = model_->body_id[std::size_t(pull_.body)];
  const Vector3d point = placed(d, id, pull_.point);
  const mjtNum* twist = d.cvel + 6 * id;
  const Vector3d velocity =
      Vector(twist + 3) + Vector(twist).cross(point - Vector(d.subtree_com + 3 * m.body_rootid[id]));
  const double w = kPullFrequency;
  pull_force_ = m.body_subtreemass[id] * (w * w * (pull_.target - point) - 2. * w * velocity);
  Eigen::Map<Vector6d> applied(d.xfrc_applied + 6 * id);
  pushed_before_ = applied;
  applied.head<3>() += pull_force_;
  applied.tail<3>() += (point - Vector(d.xipos + 3 * id)).cross(pull_force_);
}

void World::removePull() {
  const int id = model_->body_id[std::size_t(pull_.body)];
  std::copy_n(pushed_before_.data(), 6, data_->xfrc_applied + 6 * id);
}

}  // namespace kinegraph
