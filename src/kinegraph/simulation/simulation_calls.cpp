#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/simulation/simulation_impl.h"

namespace kinegraph {

namespace {

bool isBelow(const FrameData* frame, const FrameData& above) {
  while (frame && frame != &above) frame = frame->parent;
  return frame != nullptr;
}

/// Returns the first frame of the frame's link.
const FrameData& linkOf(const FrameData& frame) {
  const FrameData* root = &frame;
  while (root->parent && !root->joint) root = root->parent;
  return *root;
}

void expectPositive(const char* call, const char* what, double value) {
  if (!(value > 0.) || !std::isfinite(value))
    throw ValueError(cat(call, ": ", what, " is ", value, "; expected a positive number"));
}

}  // namespace

const FrameData& Simulation::Impl::frame(const std::string& name, const char* call) const {
  return config.scene()->get(name, call);
}

int Simulation::Impl::body(const std::string& name, const char* call) const {
  return world->scene().scene.frames[std::size_t(frame(name, call).id)].body;
}

/// Returns the gripper of a frame: the first in the order of frames below its link.
std::size_t Simulation::Impl::gripper(const std::string& name, const char* call) const {
  const FrameData& link = linkOf(frame(name, call));
  const SceneModel& model = world->scene();
  for (std::size_t g = 0; g < model.grippers.size(); ++g) {
    const int joint = model.joints[std::size_t(model.grippers[g].joint)].frame;
    if (isBelow(frames[std::size_t(joint)].get(), link)) return g;
  }
  std::vector<std::string> there;
  for (const GripperJoint& each : model.grippers)
    there.push_back(frames[std::size_t(model.joints[std::size_t(each.joint)].frame)]->name);
  throw ValueError(cat(call, ": there is no gripper below the link of frame '", name,
                       "'; a gripper is an inactive joint that other joints mimic",
                       there.empty() ? "; the scene has no gripper" : cat("; grippers of the scene: ", join(there))));
}

void Simulation::moveGripper(const std::string& gripper, double width, double speed) {
  closeGripper(gripper, width, speed, 20.);
}

void Simulation::closeGripper(const std::string& gripper, double width, double speed, double force) {
  update();
  Impl& s = *impl_;
  const char* call = "Simulation.moveGripper";
  const std::size_t g = s.gripper(gripper, call);
  if (!std::isfinite(width) || width < 0.)
    throw ValueError(cat(call, ": width is ", width, " m; expected a number >= 0"));
  expectPositive(call, "speed", speed);
  expectPositive(call, "force", force);
  const GripperJoint& joint = s.world->scene().grippers[g];
  GripperTask& task = s.world->grippers()[g];
  task.reference = s.world->positions()[joint.qpos[0]];
  task.target = std::clamp(joint.opening.positionAt(width), joint.lower, joint.upper);
  const double opens = joint.opening.slopeAt(task.target), slope = std::abs(opens), parts = double(joint.qpos.size());
  task.speed = 2. * speed / slope;
  task.force = force * slope / parts;  // of each joint, m or rad
  const double reach = task.force * parts / joint.stiffness;
  if (opens > 0. && task.target == joint.lower) task.target -= reach;  // thin objects are pressed with all of the force
  if (opens < 0. && task.target == joint.upper) task.target += reach;
  task.still = 0.;
  s.record(Recording::Call::Kind::gripper, {width, speed, force}, {gripper});
}

bool Simulation::gripperIsDone(const std::string& gripper) const {
  return impl_->world->isGripperDone(int(impl_->gripper(gripper, "Simulation.gripperIsDone")));
}

double Simulation::getGripperWidth(const std::string& gripper) const {
  const GripperJoint& joint = impl_->world->scene().grippers[impl_->gripper(gripper, "Simulation.getGripperWidth")];
  return joint.opening.widthAt(impl_->world->positions()[joint.qpos[0]]);
}

void Simulation::attach(const std::string& from, const std::string& to) {
  update();
  const int a = impl_->body(from, "Simulation.attach"), b = impl_->body(to, "Simulation.attach");
  if (a == b) throw ValueError(cat("Simulation.attach: '", from, "' and '", to, "' already belong to the same link"));
  impl_->world->weld(a, b);
  impl_->record(Recording::Call::Kind::attach, {}, {from, to});
}

void Simulation::detach(const std::string& from, const std::string& to) {
  update();
  const int a = impl_->body(from, "Simulation.detach"), b = impl_->body(to, "Simulation.detach");
  const bool either = impl_->world->unweld(a, b) || impl_->world->unweld(b, a);
  if (!either) throw ValueError(cat("Simulation.detach: '", to, "' is not attached to '", from, "'"));
  impl_->record(Recording::Call::Kind::detach, {}, {from, to});
}

// --- splines ------------------------------------------------------------------------------------------------------

void Simulation::setSplineRef(const MatrixXd& path, const VectorXd& times, bool append) {
  update();
  Impl& s = *impl_;
  const char* call = "Simulation.setSplineRef";
  const int n = s.world->scene().dofs;
  if (path.rows() == 0 || path.cols() != n)
    throw ValueError(cat(call, ": path has shape (", path.rows(), ", ", path.cols(), "); expected (K, ", n, ")"));
  if (times.size() != 1 && times.size() != path.rows())
    throw ValueError(cat(call, ": times has ", times.size(), " entries; expected 1 or ", path.rows()));
  const VectorXd at = times.size() == path.rows()
                          ? times
                          : VectorXd(VectorXd::LinSpaced(path.rows(), times[0] / double(path.rows()), times[0]));
  if (!(at[0] > 0.)) throw ValueError(cat(call, ": the first time is ", at[0], " s; expected a positive number"));
  Reference& reference = s.world->reference();
  const double now = s.world->time(),
               end = reference.spline.isEmpty() ? now : reference.spline_start + reference.spline.end();
  BSpline next = reference.spline;
  if (append && end > now) {
    next.append(path, at);
  } else if (!append && end > now) {
    next.overwriteSmooth(path, at, now - reference.spline_start);
  } else {
    MatrixXd points(path.rows() + 1, n);
    points << getReference().transpose(), path;
    VectorXd all(at.size() + 1);
    all << 0., at;
    next.set(3, points, all);
    reference.spline_start = now;
  }
  reference.spline = next;
  std::vector<double> numbers{append ? 1. : 0., double(path.rows()), double(path.cols())};
  numbers.insert(numbers.end(), path.data(), path.data() + path.size());
  numbers.insert(numbers.end(), times.begin(), times.end());
  s.record(Recording::Call::Kind::spline, std::move(numbers));
}

double Simulation::getTimeToSplineEnd() const {
  const Reference& reference = impl_->world->reference();
  if (reference.spline.isEmpty()) return 0.;
  return reference.spline_start + reference.spline.end() - impl_->world->time();
}

void Simulation::Impl::resetSpline(double ctrl_time) {
  const VectorXd now = q();
  MatrixXd points(2, now.size());
  points << now.transpose(), now.transpose();
  const double length = 1e-3;
  Reference& reference = world->reference();
  if (now.size() > 0) reference.spline.set(1, points, Eigen::Vector2d(0., length));
  reference.spline_start = (ctrl_time < 0. ? world->time() : ctrl_time) - length;
}

void Simulation::resetSplineRef(double ctrl_time) {
  update();
  if (!std::isfinite(ctrl_time))
    throw ValueError(cat("Simulation.resetSplineRef: ctrl_time is ", ctrl_time, "; expected a finite number"));
  impl_->resetSpline(ctrl_time);
  impl_->record(Recording::Call::Kind::reset_spline, {ctrl_time});
}

void Simulation::multi_step(double tau_step, double tau_sim, const CancellationToken& cancellation) {
  expectPositive("Simulation.multi_step", "tau_step", tau_step);
  expectPositive("Simulation.multi_step", "tau_sim", tau_sim);
  const double steps = std::round(tau_step / tau_sim);
  if (steps > 1e7) throw ValueError(cat("Simulation.multi_step: ", steps, " steps; expected at most 1e7"));
  if (impl_->observer) {
    for (int i = 0; i < int(steps); ++i) {
      cancellation.check();
      step({}, tau_sim, ControlMode::spline);
    }
    return;
  }
  update();
  for (int i = 0; i < int(steps); ++i) {
    cancellation.check();
    advance({}, tau_sim, ControlMode::spline);
  }
  publish();
}

// --- measuring ----------------------------------------------------------------------------------------------------

std::vector<Contact> Simulation::getContacts() const {
  const auto name = [&](int geom) {
    const int frame = impl_->world->scene().geom_frame[std::size_t(geom)];
    return frame < 0 ? std::string("ground") : impl_->frames[std::size_t(frame)]->name;
  };
  std::vector<Contact> found;
  for (const GeomContact& contact : impl_->world->contacts())
    found.push_back({name(contact.geom_a), name(contact.geom_b), contact.position, contact.normal, contact.distance,
                     contact.force});
  return found;
}

VectorXd Simulation::getJointTorques() const { return impl_->world->motorTorques(); }
VectorXd Simulation::getExternalTorques() const { return impl_->world->externalTorques(); }

void Simulation::addForceTorqueSensor(const std::string& frame) {
  impl_->frame(frame, "Simulation.addForceTorqueSensor");
  impl_->force_frames.push_back(impl_->frames[std::size_t(impl_->frame(frame, "").id)]);
  impl_->rebuild();
}

void Simulation::addAccelerometer(const std::string& frame) {
  impl_->acceleration_frames.push_back(
      impl_->frames[std::size_t(impl_->frame(frame, "Simulation.addAccelerometer").id)]);
  impl_->rebuild();
}

namespace {

const mjtNum* sensorNumbers(const World& world, const std::vector<ModelSensor>& sensors, const FrameData& frame,
                            const char* call, const char* add) {
  for (const ModelSensor& sensor : sensors) {
    if (sensor.frame == frame.id) return world.computed().sensordata + sensor.address;
  }
  throw ValueError(cat(call, ": frame '", frame.name, "' has no such sensor; call ", add, " first"));
}

}  // namespace

Vector6d Simulation::getForceTorque(const std::string& frame) const {
  const char* call = "Simulation.getForceTorque";
  return Eigen::Map<const Vector6d>(sensorNumbers(*impl_->world, impl_->world->scene().force_sensors,
                                                  impl_->frame(frame, call), call, "addForceTorqueSensor"));
}

Vector3d Simulation::getAcceleration(const std::string& frame) const {
  const char* call = "Simulation.getAcceleration";
  return Eigen::Map<const Vector3d>(sensorNumbers(*impl_->world, impl_->world->scene().accelerometers,
                                                  impl_->frame(frame, call), call, "addAccelerometer"));
}

void Simulation::applyForce(const std::string& frame, const Vector3d& force, const Vector3d& torque,
                            const std::optional<Vector3d>& point) {
  update();
  const char* call = "Simulation.applyForce";
  if (!force.allFinite() || !torque.allFinite() || (point && !point->allFinite()))
    throw ValueError(cat(call, ": force, torque and point must be finite"));
  const FrameData& data = impl_->frame(frame, call);
  const PlacedFrame& placed = impl_->world->scene().scene.frames[std::size_t(data.id)];
  if (placed.body == 0)
    throw ValueError(cat(call, ": frame '", frame, "' is fixed to the world and no force can move it"));
  std::vector<double> numbers(force.begin(), force.end());
  numbers.insert(numbers.end(), torque.begin(), torque.end());
  if (point) numbers.insert(numbers.end(), point->begin(), point->end());
  impl_->record(Recording::Call::Kind::apply_force, std::move(numbers), {frame});
  impl_->world->applyForce(placed.body, force, torque,
                           point ? *point : (impl_->world->bodyPose(placed.body) * placed.X_BF).p);
}

void Simulation::perturb(const std::string& frame, const Vector3d& point, const Vector3d& target) {
  update();
  const char* call = "Simulation.perturb";
  if (!point.allFinite() || !target.allFinite()) throw ValueError(cat(call, ": point and target must be finite"));
  const FrameData& data = impl_->frame(frame, call);
  World& world = *impl_->world;
  const PlacedFrame& placed = world.scene().scene.frames[std::size_t(data.id)];
  if (!world.canMove(placed.body))
    throw ValueError(cat(call, ": frame '", frame, "' is fixed to the world and cannot be perturbed"));
  world.perturb({placed.body, placed.X_BF.p + placed.X_BF.q * point, target});
  std::vector<double> numbers(point.begin(), point.end());
  numbers.insert(numbers.end(), target.begin(), target.end());
  impl_->record(Recording::Call::Kind::perturb, std::move(numbers), {frame});
}

void Simulation::endPerturbation() {
  if (impl_->world->perturbation().body == 0) return;
  impl_->world->perturb({});
  impl_->record(Recording::Call::Kind::end_perturbation, {});
}

std::optional<Perturbation> Simulation::getPerturbation() const {
  const World& world = *impl_->world;
  if (world.perturbation().body == 0) return std::nullopt;
  return Perturbation{world.perturbedPoint(), world.perturbation().target, world.perturbationForce()};
}

void Simulation::clearForces() {
  impl_->world->clearForces();
  impl_->record(Recording::Call::Kind::clear_forces, {});
}

}  // namespace kinegraph
