#include "kinegraph/simulation/simulation.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/simulation/simulation_impl.h"

namespace kinegraph {

Simulation::Simulation(Config& config, SimulationEngine engine, const SimulationOptions& options)
    : impl_("Simulation", std::make_unique<Impl>(config, engine, options)) {}
Simulation::Simulation(const Simulation& other, SameModel)
    : impl_("Simulation", std::make_unique<Impl>(*other.impl_)) {}
Simulation::Simulation(std::unique_ptr<Impl> impl) : impl_("Simulation", std::move(impl)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

Simulation::Impl::Impl(const Config& source, SimulationEngine which, const SimulationOptions& chosen, bool for_batch)
    : config(source.scene()), engine(which), options(chosen), can_change_frictions(for_batch) {
  if (engine == SimulationEngine::bullet)
    throw ValueError("Simulation: there is no engine bullet; use physx (rigid bodies with contacts) or kinematic");
  if (engine != SimulationEngine::physx && engine != SimulationEngine::kinematic)
    throw ValueError(cat("Simulation: there is no engine ", int(engine), "; expected physx (1) or kinematic (3)"));
  options.validate();
  world = makeWorld();
  readConfig(*world);
  world->settle();
}

Simulation::Impl::Impl(const Impl& other)
    : config(other.config.scene()),
      engine(other.engine),
      options(other.options),
      can_change_frictions(other.can_change_frictions),
      force_frames(other.force_frames),
      acceleration_frames(other.acceleration_frames),
      world(std::make_unique<World>(other.world->sharedScene(), options, engine == SimulationEngine::kinematic)),
      frames(other.frames),
      revision(other.revision) {
  world->setState(other.world->state());
}

std::unique_ptr<World> Simulation::Impl::makeWorld() {
  SceneTree& scene = *config.scene();
  ModelExtras at;
  at.can_change_frictions = can_change_frictions;
  for (const auto& frame : force_frames) {
    if (frame->tree == &scene) at.forces.insert(frame->id);
  }
  for (const auto& frame : acceleration_frames) {
    if (frame->tree == &scene) at.accelerations.insert(frame->id);
  }
  auto model = std::make_shared<SceneModel>(makeSceneModel(scene, options, at));
  const std::vector<HandFingers> hands =
      model->grippers.empty() ? std::vector<HandFingers>() : handFingersOf(Config(scene));
  for (GripperJoint& gripper : model->grippers) {
    const ModelJoint& joint = model->joints[std::size_t(gripper.joint)];
    for (const HandFingers& hand : hands)
      if (hand.joint == scene.frames()[std::size_t(joint.frame)]->name) gripper.opening = hand.scaled(joint.scale);
  }
  auto made = std::make_unique<World>(model, options, engine == SimulationEngine::kinematic);
  frames = scene.frames();
  revision = scene.structureRevision();
  for (const std::string& warning : model->scene.warnings) {
    if (warned.insert(warning).second) warnings.push_back(warning);
  }
  return made;
}

void Simulation::Impl::readConfig(World& to) const {
  const SceneModel& model = to.scene();
  for (const ModelJoint& joint : model.joints)
    writeJoint(joint, frames[std::size_t(joint.frame)]->joint->q.data(), to.positions());
  for (std::size_t i = 0; i < model.free_frames.size(); ++i)
    writeFreePose(config.scene()->worldPose(*frames[std::size_t(model.free_frames[i])]),
                  to.positions() + model.free_qpos[i]);
}

void Simulation::update() {
  if (impl_->config.scene()->structureRevision() != impl_->revision) renew();
}

void Simulation::renew() {
  Impl& s = *impl_;
  if (isRecording()) {
    s.recording->end = getState();
    s.recording->is_cut = true;
  }
  s.rebuild();
}

void Simulation::advance(const VectorXd& u, double tau, ControlMode mode, const CancellationToken& cancellation) {
  impl_->world->step(u, tau, mode, cancellation);
  impl_->warnOfFastRotations();
  if (!isRecording()) return;
  std::vector<double> numbers{tau, double(int(mode))};
  numbers.insert(numbers.end(), u.begin(), u.end());
  impl_->record(Recording::Call::Kind::step, std::move(numbers));
  impl_->recordPoses();
}

void Simulation::Impl::warnOfFastRotations() {
  for (const int body : world->tooFast()) {
    const FrameData* frame = world->scene().scene.bodies[std::size_t(body)].frame;
    const std::string name = frame ? frame->name : "";
    if (!warned.insert(cat("rotates ", name)).second) continue;
    warnings.push_back(cat("Simulation: '", name, "' rotates by more than .5 rad in an inner step of ",
                           world->model().opt.timestep, " s; its motion is unreliable: use a smaller inner_step"));
  }
}

void Simulation::setObserver(std::shared_ptr<SimulationObserver> observer) { impl_->observer = std::move(observer); }
const std::shared_ptr<SimulationObserver>& Simulation::observer() const { return impl_->observer; }

void Simulation::publish() { impl_->writeConfig(); }

void Simulation::step(const VectorXd& u, double tau, ControlMode mode) {
  SimulationObserver* observer = impl_->observer.get();
  while (observer && !observer->mayStep(*this)) observer->rest();
  update();
  try {
    advance(u, tau, mode);
  } catch (const DivergenceError&) {
    if (!observer || !observer->replaceStep(*this, tau)) throw;
  }
  publish();
  if (observer) observer->afterStep(*this);
}

void Simulation::Impl::writeConfig() {
  const SceneModel& model = world->scene();
  SceneTree& scene = *config.scene();
  if (scene.structureRevision() != revision) return;
  const mjtNum* qpos = world->positions();
  for (const ModelJoint& joint : model.joints) {
    FrameData& frame = *frames[std::size_t(joint.frame)];
    VectorXd& q = frame.joint->q;
    if (joint.first_q >= 0) {
      readJoint(joint, qpos, q.data());
      continue;
    }
    using FewNumbers = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 7, 1>;  // on the stack
    const FewNumbers before = q;
    readJoint(joint, qpos, q.data());
    if (q != before) scene.posesChanged();
  }
  scene.jointsChanged();
  for (std::size_t i = 0; i < model.free_frames.size(); ++i) {
    FrameData& frame = *frames[std::size_t(model.free_frames[i])];
    Pose pose = readFreePose(qpos + model.free_qpos[i]);
    if (frame.parent) {
      const PlacedFrame& on = model.scene.frames[std::size_t(frame.parent->id)];
      pose = (world->bodyPose(on.body) * on.X_BF).inverse() * pose;
    }
    if (frame.moves()) {
      frame.joint->q = motionProject(frame.joint->steps, frame.joint->axis, motionScale(frame), pose);
      if (!frame.joint->active) scene.posesChanged();
    } else {
      frame.pose = pose;
      scene.poseChanged(frame);
    }
  }
}

double Simulation::get_t() const { return impl_->world->time(); }

void Simulation::resetTime(double time) {
  if (!std::isfinite(time)) throw ValueError(cat("Simulation.resetTime: time is ", time, "; expected a finite number"));
  impl_->world->setTime(time);
  impl_->resetSpline(-1.);
  impl_->record(Recording::Call::Kind::reset_time, {time});
}

const Config& Simulation::config() const { return impl_->config; }
SimulationEngine Simulation::engine() const { return impl_->engine; }
const SimulationOptions& Simulation::options() const { return impl_->options; }

VectorXd Simulation::Impl::q() const {
  VectorXd q(world->scene().dofs);
  readPositions(q);
  return q;
}

VectorXd Simulation::Impl::qDot() const {
  VectorXd velocity(world->scene().dofs);
  readVelocities(velocity);
  return velocity;
}

void Simulation::Impl::readPositions(Eigen::Ref<VectorXd> q) const {
  requireSize(q, "get_q");
  q.setZero();
  for (const ModelJoint& joint : world->scene().joints) {
    if (joint.first_q >= 0) readJoint(joint, world->positions(), q.data() + joint.first_q);
  }
}

void Simulation::Impl::readVelocities(Eigen::Ref<VectorXd> velocity) const {
  requireSize(velocity, "get_qDot");
  velocity.setZero();
  for (const ModelJoint& joint : world->scene().joints) {
    if (joint.first_q >= 0)
      readJointVelocity(joint, world->positions(), world->velocities(), velocity.data() + joint.first_q);
  }
}

void Simulation::Impl::requireSize(const Eigen::Ref<VectorXd>& numbers, const char* call) const {
  if (numbers.size() != world->scene().dofs)
    throw ValueError(cat("Simulation.", call, ": there is room for ", numbers.size(), " numbers; expected ",
                         world->scene().dofs, ", one per dof"));
}

MatrixXd Simulation::Impl::freePoses() const {
  const SceneModel& model = world->scene();
  MatrixXd poses(long(model.free_frames.size()), 7);
  for (long i = 0; i < poses.rows(); ++i) {
    const mjtNum* p = world->positions() + model.free_qpos[std::size_t(i)];
    poses.row(i) = Eigen::Map<const Vector7d>(p).transpose();
  }
  return poses;
}

MatrixXd Simulation::Impl::freeVelocities() const {
  const SceneModel& model = world->scene();
  MatrixXd velocities(long(model.free_frames.size()), 6);
  for (long i = 0; i < velocities.rows(); ++i) {
    const mjtNum* v = world->velocities() + model.free_dof[std::size_t(i)];
    const Pose pose = readFreePose(world->positions() + model.free_qpos[std::size_t(i)]);
    velocities.row(i).head<3>() = Eigen::Map<const Vector3d>(v).transpose();
    velocities.row(i).tail<3>() = (pose.q * Vector3d(v[3], v[4], v[5])).transpose();
  }
  return velocities;
}

void Simulation::Impl::setFreeVelocities(const MatrixXd& velocities) {
  const SceneModel& model = world->scene();
  for (long i = 0; i < velocities.rows(); ++i) {
    mjtNum* v = world->velocities() + model.free_dof[std::size_t(i)];
    const Pose pose = readFreePose(world->positions() + model.free_qpos[std::size_t(i)]);
    const Vector3d angular = pose.q.conjugate() * Vector3d(velocities.row(i).tail<3>());
    for (int k = 0; k < 3; ++k) {
      v[k] = velocities(i, k);
      v[3 + k] = angular[k];
    }
  }
}

VectorXd Simulation::get_q() const { return impl_->q(); }
VectorXd Simulation::get_qDot() const { return impl_->qDot(); }
void Simulation::get_q(Eigen::Ref<VectorXd> q) const { impl_->readPositions(q); }
void Simulation::get_qDot(Eigen::Ref<VectorXd> velocity) const { impl_->readVelocities(velocity); }
MatrixXd Simulation::get_frameVelocities() const { return impl_->freeVelocities(); }

std::vector<Frame> Simulation::getFreeFrames() const {
  std::vector<Frame> found;
  for (const int id : impl_->world->scene().free_frames)
    found.emplace_back(impl_->config.scene(), *impl_->frames[std::size_t(id)]);
  return found;
}

VectorXd Simulation::getReference() const {
  const World& world = *impl_->world;
  std::vector<mjtNum> positions(world.data().qpos, world.data().qpos + world.model().nq);
  for (std::size_t i = 0; i < world.scene().servos.size(); ++i) {
    const Servo& servo = world.scene().servos[i];
    const Reference::Dof& dof = world.reference().dofs()[i];
    if (servo.kind == MotionKind::quaternion) {
      std::copy_n(dof.rotation, 4, &positions[std::size_t(servo.qpos)]);
    } else {
      positions[std::size_t(servo.qpos)] = dof.position;
    }
  }
  VectorXd q = VectorXd::Zero(world.scene().dofs);
  for (const ModelJoint& joint : world.scene().joints) {
    if (joint.first_q >= 0) readJoint(joint, positions.data(), q.data() + joint.first_q);
  }
  return q;
}

std::vector<std::string> Simulation::takeWarnings() { return std::exchange(impl_->warnings, {}); }

}  // namespace kinegraph
