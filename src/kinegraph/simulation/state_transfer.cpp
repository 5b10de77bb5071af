#include <algorithm>

#include "kinegraph/simulation/world.h"

namespace kinegraph::inline simulation_internal {

void World::forgetForces() {
  std::fill_n(data_->qacc_warmstart, physics_->nv, 0.);
  is_computed_ = copy_is_computed_ = false;
}

void World::constantsChanged() {
  wake();
  const WorldState before = state();
  physics().mj_setConst(physics_.get(), data_.get());
  setState(before);
}

void World::setFriction(int frame, double friction) {
  wake();
  mjModel& m = *physics_;
  const std::vector<int>& of = model_->geom_frame;
  for (int g = 0; g < m.ngeom; ++g) {
    if (of[std::size_t(g)] == frame) m.geom_friction[3 * g] = friction;
  }
  for (int p = 0; p < m.npair; ++p) {
    const int a = m.pair_geom1[p], b = m.pair_geom2[p];
    if (of[std::size_t(a)] != frame && of[std::size_t(b)] != frame) continue;
    const bool largest = model_->geom_takes_largest[std::size_t(a)] && model_->geom_takes_largest[std::size_t(b)];
    const double of_a = m.geom_friction[3 * a], of_b = m.geom_friction[3 * b];
    m.pair_friction[5 * p] = m.pair_friction[5 * p + 1] = largest ? std::max(of_a, of_b) : .5 * (of_a + of_b);
  }
}

void World::transferState(const World& old, const std::function<int(int frame)>& old_frame) {
  const SceneModel &to = *model_, &from = *old.model_;
  setTime(old.time());
  for (std::size_t i = 0; i < to.free_frames.size(); ++i) {
    const auto found = std::find(from.free_frames.begin(), from.free_frames.end(), old_frame(to.free_frames[i]));
    if (found == from.free_frames.end()) continue;
    const auto j = std::size_t(found - from.free_frames.begin());
    std::copy_n(old.data_->qpos + from.free_qpos[j], 7, data_->qpos + to.free_qpos[i]);
    std::copy_n(old.data_->qvel + from.free_dof[j], 6, data_->qvel + to.free_dof[i]);
  }
  std::vector<int> joint_was(to.joints.size(), -1);
  for (std::size_t i = 0; i < to.joints.size(); ++i) {
    const int was = old_frame(to.joints[i].frame);
    for (std::size_t j = 0; j < from.joints.size(); ++j) {
      if (was < 0 || from.joints[j].frame != was || from.joints[j].steps.size() != to.joints[i].steps.size()) continue;
      joint_was[i] = int(j);
      std::vector<double> q(std::size_t(from.joints[j].dofs)), velocity(q.size());
      readJoint(from.joints[j], old.data_->qpos, q.data());
      readJointVelocity(from.joints[j], old.data_->qpos, old.data_->qvel, velocity.data());
      writeJoint(to.joints[i], q.data(), data_->qpos);
      writeJointVelocity(to.joints[i], q.data(), velocity.data(), data_->qvel);
    }
  }
  settle();
  for (std::size_t i = 0; i < to.servos.size(); ++i) {
    for (std::size_t j = 0; j < from.servos.size(); ++j) {
      const Servo &a = to.servos[i], &b = from.servos[j];
      if (joint_was[std::size_t(a.joint)] != b.joint || a.kind != b.kind) continue;
      const int first = to.joints[std::size_t(a.joint)].steps.front().dof;
      if (a.dof - first == b.dof - from.joints[std::size_t(b.joint)].steps.front().dof)
        reference_.setDof(i, old.reference_.dofs()[j]);
    }
  }
  if (from.dofs == to.dofs) {
    reference_.spline = old.reference_.spline;
    reference_.spline_start = old.reference_.spline_start;
  }
  for (std::size_t i = 0; i < to.grippers.size(); ++i) {
    for (std::size_t j = 0; j < from.grippers.size(); ++j) {
      if (joint_was[std::size_t(to.grippers[i].joint)] == from.grippers[j].joint) grippers_[i] = old.grippers_[j];
    }
  }
  transferWelds(old, old_frame);
}

void World::transferWelds(const World& old, const std::function<int(int frame)>& old_frame) {
  const auto bodyNow = [&](int was) {
    if (was == 0) return 0;
    const std::vector<PlacedFrame>& frames = model_->scene.frames;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const SceneBody& body = model_->scene.bodies[std::size_t(frames[f].body)];
      if (body.frame && body.frame->id == int(f) && old_frame(int(f)) >= 0 &&
          old.model_->scene.frames[std::size_t(old_frame(int(f)))].body == was)
        return frames[f].body;
    }
    return -1;
  };
  for (const WeldedPair& pair : old.welds_) {
    if (!pair.active) continue;
    const int a = bodyNow(pair.body_a), b = bodyNow(pair.body_b);
    if (a >= 0 && b >= 0 && a != b) weld(a, b, pair.X_AB);
  }
}

}  // namespace kinegraph::inline simulation_internal
