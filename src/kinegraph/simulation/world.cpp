#include "kinegraph/simulation/world.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/rendering/mujoco.h"

namespace kinegraph::inline simulation_internal {

namespace {

constexpr double kGripTolerance = 1e-4;       ///< m: a gripper has reached its target
constexpr std::size_t kRestingContacts = 16;  ///< usual number per sleeping body
constexpr double kStillFor = .02;             ///< s without motion after which fingers count as stopped

int stateSize(const mjModel& m) { return physics().mj_stateSize(&m, mjSTATE_INTEGRATION); }

}  // namespace

World::World(std::shared_ptr<const SceneModel> model, const SimulationOptions& options, bool is_kinematic)
    : model_(std::move(model)),
      options_(options),
      is_kinematic_(is_kinematic),
      physics_(nullptr, physics().mj_deleteModel),
      data_(nullptr, physics().mj_deleteData),
      computed_(nullptr, physics().mj_deleteData) {
  const Physics& mj = physics();
  const MujocoErrors thrown;
  physics_.reset(mj.mj_copyModel(nullptr, model_->model.get()));
  data_.reset(mj.mj_makeData(physics_.get()));
  if (!data_) throw Error("Simulation: there is not enough memory");
  welds_.resize(std::size_t(model_->welds));
  for (const GripperJoint& gripper : model_->grippers) {
    GripperTask task;
    task.target = task.reference = data_->qpos[gripper.qpos[0]];
    grippers_.push_back(task);
  }
  bias_.resize(6 * std::size_t(physics_->nbody));
  desired_acceleration_.resize(std::size_t(physics_->nv));
  torque_.resize(std::size_t(physics_->nv));
  resting_contacts_.reserve(kRestingContacts * std::size_t(physics_->ntree));  // steps request no memory
  if (!options_.speculative) contact_search_ = ContactSearch(*physics_);
  gyroscopic_forces_ = GyroscopicForces(*model_, *physics_);
  settle();
}

void World::settle() {
  wake();
  for (const SceneModel::Follower& f : model_->followers) {
    data_->qpos[f.qpos] = f.ratio * data_->qpos[f.source_qpos];
    data_->qvel[f.dof] = f.ratio * data_->qvel[f.source_dof];
  }
  reference_.holdAt(*model_, data_->qpos, data_->qvel);
  for (std::size_t g = 0; g < grippers_.size(); ++g) {
    GripperTask& task = grippers_[g];
    task.target = task.reference = data_->qpos[model_->grippers[g].qpos[0]];
    task.still = 0.;
  }
  is_computed_ = copy_is_computed_ = false;
}

bool World::isGripperDone(int gripper) const {
  const GripperTask& task = grippers_[std::size_t(gripper)];
  const double q = data_->qpos[model_->grippers[std::size_t(gripper)].qpos[0]];
  return (task.reference == task.target && std::abs(q - task.target) < kGripTolerance) || task.still >= kStillFor;
}

WorldState World::state() const {
  WorldState state;
  saveState(state);
  return state;
}

void World::saveState(WorldState& state) const {
  state.physics.resize(std::size_t(stateSize(*physics_)));
  physics().mj_getState(physics_.get(), data_.get(), state.physics.data(), mjSTATE_INTEGRATION);
  state.sleep.assign(data_->tree_asleep, data_->tree_asleep + physics_->ntree);
  state.reference = reference_;
  state.grippers = grippers_;
  state.welds = welds_;
  state.perturbation = perturbation_;
}

void World::setState(const WorldState& state) {
  physics().mj_setState(physics_.get(), data_.get(), state.physics.data(), mjSTATE_INTEGRATION);
  reference_ = state.reference;
  grippers_ = state.grippers;
  welds_ = state.welds;
  perturbation_ = state.perturbation;
  perturbation_force_.setZero();
  for (std::size_t slot = 0; slot < welds_.size(); ++slot) activate(slot);
  restoreSleep(state.sleep);
  for (mjWarningStat& warning : data_->warning) warning = {};
  is_computed_ = copy_is_computed_ = false;
}

void World::activate(std::size_t slot) {
  const WeldedPair& pair = welds_[slot];
  const int id = model_->first_weld + int(slot);
  mjModel& m = *physics_;
  data_->eq_active[id] = pair.active;
  if (!pair.active) return;
  m.eq_obj1id[id] = model_->body_id[std::size_t(pair.body_a)];
  m.eq_obj2id[id] = model_->body_id[std::size_t(pair.body_b)];
  mjtNum* data = m.eq_data + mjNEQDATA * id;
  std::fill_n(data, 3, 0.);
  std::copy_n(pair.X_AB.p.data(), 3, data + 3);
  std::copy_n(wxyz(pair.X_AB.q).data(), 4, data + 6);
  data[10] = 1.;
}

void World::weld(int body_a, int body_b) { weld(body_a, body_b, bodyPose(body_a).inverse() * bodyPose(body_b)); }

void World::weld(int body_a, int body_b, const Pose& X_AB) {
  for (std::size_t slot = 0; slot < welds_.size(); ++slot) {
    if (welds_[slot].active) continue;
    wake(body_a);
    wake(body_b);
    welds_[slot] = {body_a, body_b, X_AB, true};
    activate(slot);
    return;
  }
  throw ValueError(
      cat("Simulation.attach: ", welds_.size(), " objects are attached; expected at most this many at once"));
}

bool World::unweld(int body_a, int body_b) {
  bool found = false;
  for (std::size_t slot = 0; slot < welds_.size(); ++slot) {
    WeldedPair& pair = welds_[slot];
    if (!pair.active || pair.body_a != body_a || pair.body_b != body_b) continue;
    wake(body_a);
    wake(body_b);
    pair.active = false;
    activate(slot);
    found = true;
  }
  return found;
}

void World::applyForce(int body, const Vector3d& force, const Vector3d& torque, const Vector3d& point) {
  wake(body);
  const int id = model_->body_id[std::size_t(body)];
  const Pose X_WB = bodyPose(body);
  const Vector3d com = X_WB.p + X_WB.q * Vector3d(Eigen::Map<const Vector3d>(physics_->body_ipos + 3 * id));
  mjtNum* applied = data_->xfrc_applied + 6 * id;
  const Vector3d about = torque + (point - com).cross(force);
  for (int i = 0; i < 3; ++i) {
    applied[i] += force[i];
    applied[3 + i] += about[i];
  }
}

void World::clearForces() { std::fill_n(data_->xfrc_applied, 6 * physics_->nbody, 0.); }

VectorXd World::motorTorques() const {
  VectorXd torques = VectorXd::Zero(model_->dofs);
  for (const Servo& servo : model_->servos) {
    if (servo.q >= 0 && servo.kind != MotionKind::quaternion)
      torques[servo.q] = servo.scale * data_->qfrc_applied[servo.dof];
  }
  return torques;
}

const mjData& World::computed() const {
  if (is_computed_) return *data_;
  if (!copy_is_computed_) {
    const Physics& mj = physics();
    const MujocoErrors thrown;
    computed_.reset(mj.mj_copyData(computed_.release(), physics_.get(), data_.get()));
    mj.mj_forward(physics_.get(), computed_.get());
    copy_is_computed_ = true;
  }
  return *computed_;
}

VectorXd World::externalTorques() const {
  const mjData& d = computed();
  std::vector<mjtNum> pushed(std::size_t(physics_->nv), 0.);
  for (int b = 1; b < physics_->nbody; ++b) {
    const mjtNum* f = d.xfrc_applied + 6 * b;
    if (std::any_of(f, f + 6, [](double x) { return x != 0.; }))
      physics().mj_applyFT(physics_.get(), const_cast<mjData*>(&d), f, f + 3, d.xipos + 3 * b, b, pushed.data());
  }
  if (perturbation_.body != 0) {
    const int b = model_->body_id[std::size_t(perturbation_.body)];
    const Vector3d point = perturbedPoint(), none = Vector3d::Zero();
    physics().mj_applyFT(physics_.get(), const_cast<mjData*>(&d), perturbation_force_.data(), none.data(), point.data(),
                         b, pushed.data());
  }
  VectorXd torques = VectorXd::Zero(model_->dofs);
  for (const Servo& servo : model_->servos) {
    if (servo.q >= 0 && servo.kind != MotionKind::quaternion)
      torques[servo.q] = servo.scale * (d.qfrc_constraint[servo.dof] + pushed[std::size_t(servo.dof)]);
  }
  return torques;
}

Pose World::bodyPose(int body) const {
  const SceneBody& of = model_->scene.bodies[std::size_t(body)];
  const mjModel& m = *physics_;
  switch (of.kind) {
    case SceneBody::Kind::world:
      return {};
    case SceneBody::Kind::free:
      return readFreePose(data_->qpos + m.jnt_qposadr[m.body_jntadr[model_->body_id[std::size_t(body)]]]);
    case SceneBody::Kind::fixed:
      return bodyPose(of.parent) * of.X_PB;
    case SceneBody::Kind::jointed:
      break;
  }
  Pose X = bodyPose(of.parent) * of.X_PB;
  const int id = model_->body_id[std::size_t(body)];
  for (int j = m.body_jntadr[id]; j < m.body_jntadr[id] + m.body_jntnum[id]; ++j) {
    const mjtNum* q = data_->qpos + m.jnt_qposadr[j];
    const Eigen::Map<const Vector3d> axis(m.jnt_axis + 3 * j);
    if (m.jnt_type[j] == mjJNT_SLIDE) X = X * Pose(q[0] * axis, Quaterniond::Identity());
    if (m.jnt_type[j] == mjJNT_HINGE) X = X * Pose(Vector3d::Zero(), Quaterniond(Eigen::AngleAxisd(q[0], axis)));
    if (m.jnt_type[j] == mjJNT_BALL) X = X * Pose(Vector3d::Zero(), Quaterniond(q[0], q[1], q[2], q[3]));
  }
  return X;
}

}  // namespace kinegraph::inline simulation_internal
