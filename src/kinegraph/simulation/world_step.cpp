#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/rendering/mujoco.h"
#include "kinegraph/simulation/world.h"

namespace kinegraph::inline simulation_internal {

namespace {

constexpr double kStill = 1e-3;       ///< m/s: slower fingers count as stopped
constexpr double kSlowBounce = .05;   ///< m/s: slower impacts do not bounce
constexpr double kLongestStep = 1e4;  ///< s, of one call

bool hasSurfaceVelocity(const mjModel& m, int geom) {
  const mjtNum* velocity = m.geom_surfacevel + 6 * geom;
  return std::any_of(velocity, velocity + 6, [](mjtNum v) { return v != 0.; });
}

/// MuJoCo's impedance for solimp with midpoint .5 and power 2, as in all contacts of these models.
double impedance(const mjContact& contact) {
  const double x = std::min(1., std::abs(contact.dist - contact.includemargin) / contact.solimp[2]);
  const double y = x < .5 ? 2. * x * x : 1. - 2. * (1. - x) * (1. - x);
  return contact.solimp[0] + y * (contact.solimp[1] - contact.solimp[0]);
}

}  // namespace

void World::checkCommand(const VectorXd& u, double tau, ControlMode mode) const {
  if (!(tau > 0.) || tau > kLongestStep)
    throw ValueError(cat("Simulation.step: tau is ", tau, " s; expected a positive number up to ", kLongestStep));
  const int size = controlSize(mode, model_->dofs);
  if (u.size() != size)
    throw ValueError(cat("Simulation.step: u_control has ", u.size(), " entries; mode ", controlModeName(mode),
                         size == 0 ? " takes none" : cat(" takes ", size, ", the joints' ", model_->dofs, " dofs")));
  if (!u.allFinite()) throw ValueError(cat("Simulation.step: u_control is not finite: ", u.transpose()));
  if (mode == ControlMode::velocity || mode == ControlMode::acceleration || mode == ControlMode::torque) {
    for (const Servo& servo : model_->servos) {
      if (servo.q >= 0 && (servo.kind == MotionKind::quaternion || servo.kind == MotionKind::circle))
        throw ValueError(cat("Simulation.step: mode ", controlModeName(mode), " does not apply to the joint at index ",
                             servo.q, " of q, which is a quaternion; use mode position"));
    }
  }
}

void World::step(const VectorXd& u, double tau, ControlMode mode, const CancellationToken& cancellation) {
  checkCommand(u, tau, mode);
  const MujocoErrors thrown;
  saveState(before_);
  try {
    const int steps = std::max(1, int(std::ceil(tau / options_.inner_step - 1e-9)));
    const double h = tau / steps, start = data_->time;
    physics_->opt.timestep = h;
    too_fast_.clear();
    reference_.command(*model_, u, tau, mode, options_, is_kinematic_);
    for (int i = 0; i < steps; ++i) {
      cancellation.check();
      if (!is_kinematic_) reference_.stayNear(*model_, data_->qpos, data_->qvel);
      reference_.prepare(*model_, data_->time, h, i + 1 == steps, options_);
      is_kinematic_ ? followReferences(h) : innerStep(h);
      reference_.shift(h);
    }
    data_->time = start + tau;
    if (mode == ControlMode::torque) reference_.holdAt(*model_, data_->qpos, data_->qvel);
  } catch (...) {
    setState(before_);
    throw;
  }
  if (perturbation_.body != 0 && diverges()) {  // a user on the page pulls too much: the pull ends
    setState(before_);
    contact_search_ = ContactSearch(*physics_);
    perturb({});
    return step(u, tau, mode, cancellation);
  }
  checkNumbers(data_->time);
  is_computed_ = !is_kinematic_;
  copy_is_computed_ = false;
}

/// Moves joints to their references, and attached bodies with them.
void World::followReferences(double h) {
  mjData& d = *data_;
  for (std::size_t i = 0; i < model_->servos.size(); ++i) {
    const Servo& servo = model_->servos[i];
    if (servo.kind == MotionKind::quaternion) {
      std::copy_n(reference_.dofs()[i].rotation, 4, d.qpos + servo.qpos);
    } else {
      d.qpos[servo.qpos] = reference_.next(i);
      d.qvel[servo.dof] = (reference_.next(i) - reference_.dofs()[i].position) / h;
    }
  }
  for (std::size_t g = 0; g < grippers_.size(); ++g) {
    GripperTask& task = grippers_[g];
    const double travel = task.speed * h;
    task.reference += std::clamp(task.target - task.reference, -travel, travel);
    d.qpos[model_->grippers[g].qpos[0]] = task.reference;
  }
  for (const SceneModel::Follower& f : model_->followers) d.qpos[f.qpos] = f.ratio * d.qpos[f.source_qpos];
  for (const WeldedPair& pair : welds_) {
    const SceneBody& held = model_->scene.bodies[std::size_t(pair.body_b)];
    if (!pair.active || held.kind != SceneBody::Kind::free) continue;
    const int id = model_->body_id[std::size_t(pair.body_b)];
    writeFreePose(bodyPose(pair.body_a) * pair.X_AB, d.qpos + physics_->jnt_qposadr[physics_->body_jntadr[id]]);
  }
  d.time += h;
}

void World::innerStep(double h) {
  const Physics& mj = physics();
  mjModel* m = physics_.get();
  mjData* d = data_.get();
  mj.mj_checkPos(m, d);
  mj.mj_checkVel(m, d);
  moveGrippers(h);
  const bool direct = reference_.mode() == ControlMode::torque;
  for (const Servo& servo : model_->servos) {
    const int dofs = servo.kind == MotionKind::quaternion ? 3 : 1;
    for (int k = servo.dof; k < servo.dof + dofs; ++k) m->dof_frictionloss[k] = direct ? servo.friction : 0.;
  }
  if (perturbation_.body != 0) wake(perturbation_.body);
  const int awake_before = d->ntree_awake;
  const bool is_needless = !options_.speculative && contact_search_.isNeedless(*m, *d);
  if (is_needless) m->opt.disableflags |= mjDSBL_CONTACT;
  mj.mj_fwdPosition(m, d);
  m->opt.disableflags &= ~mjDSBL_CONTACT;
  if (d->ntree_awake > awake_before) forgetWokenContacts();
  const int awake = d->ntree_awake;
  if (d->ncon > 0) {
    mj.mj_comVel(m, d);
    correctContacts(h);
    addBounces(h);
  }
  mj.mj_sensorPos(m, d);
  mj.mj_fwdVelocity(m, d);
  mj.mj_sensorVel(m, d);
  driveMotors(h);
  for (const SceneModel::Spring& spring : model_->springs) d->qfrc_applied[spring.dof] = 0.;
  gyroscopic_forces_.apply(*m, *d, h);
  for (const SceneModel::Spring& spring : model_->springs)
    d->qfrc_applied[spring.dof] -= spring.stiffness * (d->qpos[spring.qpos] - spring.reference);
  if (const int id = gyroscopic_forces_.tooFast(); id != 0) too_fast_.insert(model_->body_of_id[std::size_t(id)]);
  if (perturbation_.body != 0) addPerturbation();
  mj.mj_step2(m, d);
  if (perturbation_.body != 0) removePerturbation();
  if (d->ntree_awake < awake) keepRestingContacts();
  keepUnsupportedAwake();
}

/// Corrects a drift of MuJoCo's contacts. MuJoCo omits the term dJ/dt v in the rows of contacts, so objects held by
/// friction slip in a rotating hand; its step also lets positions drift by h^2/2 of that term. Both errors vanish with
/// the tangential surface velocity v* = (1/b + h/2) t (a2 - a1): t are the tangents, a_i is the acceleration of
/// the contact point of body i at zero joint acceleration, and b = 2 / (dmax timeconst). Along the normal a shifted
/// distance does the same; it also includes the drift of a step, because MuJoCo computes the force for the distance at
/// the end of the step.
void World::correctContacts(double h) {
  const mjModel& m = *physics_;
  mjData& d = *data_;
  using Vector = Eigen::Map<const Vector3d>;
  std::fill_n(bias_.begin(), 6, 0.);
  for (int b = 1; b < m.nbody; ++b) {
    mjtNum* a = &bias_[6 * std::size_t(b)];
    std::copy_n(&bias_[6 * std::size_t(m.body_parentid[b])], 6, a);
    for (int j = m.body_dofadr[b]; j < m.body_dofadr[b] + m.body_dofnum[b]; ++j) {
      for (int k = 0; k < 6; ++k) a[k] += d.cdof_dot[6 * j + k] * d.qvel[j];
    }
  }
  const auto acceleration = [&](int b, const Vector3d& point) -> Vector3d {
    const Vector3d r = point - Vector(d.subtree_com + 3 * m.body_rootid[b]);
    const mjtNum *A = &bias_[6 * std::size_t(b)], *V = d.cvel + 6 * b;
    const Vector3d w = Vector(V), velocity = Vector(V + 3) + w.cross(r);
    return Vector(A + 3) + Vector(A).cross(r) + w.cross(velocity);
  };
  for (int i = 0; i < d.ncon; ++i) {
    mjContact& contact = d.contact[i];
    if (contact.efc_address < 0 || contact.dim < 3) continue;
    const Vector point(contact.pos);
    const Vector3d missing =
        acceleration(m.geom_bodyid[contact.geom[1]], point) - acceleration(m.geom_bodyid[contact.geom[0]], point);
    const double factor = .5 * contact.solimp[1] * contact.solref[0] + .5 * h;
    // MuJoCo writes the velocities of surfaces that have one, and leaves the memory of others uninitialized
    if (!hasSurfaceVelocity(m, contact.geom[0]) && !hasSurfaceVelocity(m, contact.geom[1]))
      std::fill_n(contact.surfacevel, 3, 0.);
    contact.surfacevel[0] += factor * Vector(contact.frame + 3).dot(missing);
    contact.surfacevel[1] += factor * Vector(contact.frame + 6).dot(missing);
    // the normal has no surface velocity: a shift of the distance has the same effect
    const double dmax = contact.solimp[1], b = 2. / (dmax * contact.solref[0]);
    const double k = 1. / (dmax * dmax * contact.solref[0] * contact.solref[0] * contact.solref[1] * contact.solref[1]);
    const double shift = (1. + .5 * h * b) / (k * impedance(contact)) + .5 * h * h;
    d.efc_pos[contact.efc_address] += Vector(contact.frame).dot(missing) * shift;
  }
}

/// Lets shapes with a restitution e bounce: a contact that closes within the step gets another distance r. MuJoCo's
/// implicit step is v+ = (v - h k r) / (1 + b h + k h^2) for the approach velocity v, where k is the stiffness times
/// the impedance. The distance r yields v+ = -e v.
void World::addBounces(double h) {
  const mjModel& m = *physics_;
  mjData& d = *data_;
  using Vector = Eigen::Map<const Vector3d>;
  const auto velocity = [&](int geom, const Vector3d& point) -> Vector3d {
    const int b = m.geom_bodyid[geom];
    const mjtNum* V = d.cvel + 6 * b;
    return Vector(V + 3) + Vector(V).cross(point - Vector(d.subtree_com + 3 * m.body_rootid[b]));
  };
  for (int i = 0; i < d.ncon; ++i) {
    const mjContact& contact = d.contact[i];
    const double restitution = std::max(model_->geom_restitution[std::size_t(contact.geom[0])],
                                        model_->geom_restitution[std::size_t(contact.geom[1])]);
    if (restitution == 0. || contact.efc_address < 0) continue;
    const Vector point(contact.pos);
    const double approach =
        Vector(contact.frame).dot(velocity(contact.geom[1], point) - velocity(contact.geom[0], point));
    mjtNum& distance = d.efc_pos[contact.efc_address];
    const double margin = d.efc_margin[contact.efc_address];
    if (approach > -kSlowBounce || distance - margin + h * approach > 0.) continue;
    const double dmax = contact.solimp[1], time_constant = contact.solref[0], b = 2. / (dmax * time_constant);
    const double k = 1. / (dmax * time_constant * time_constant * contact.solref[1] * contact.solref[1]);
    distance = margin + approach * (1. + restitution * (1. + b * h + k * h * h)) / (h * k);
  }
}

/// tau = M (a_ref + 2 w (v_ref - v) + w^2 (p_ref - p)) + bias - passive, within the motor's limit.
void World::driveMotors(double h) {
  const mjModel& m = *physics_;
  mjData& d = *data_;
  const double w = options_.servo_frequency;
  std::fill(desired_acceleration_.begin(), desired_acceleration_.end(), 0.);
  const auto& references = reference_.dofs();
  for (std::size_t i = 0; i < model_->servos.size(); ++i) {
    const Servo& servo = model_->servos[i];
    const Reference::Dof& desired = references[i];
    if (servo.kind == MotionKind::quaternion) {
      const Quaterniond now(d.qpos[servo.qpos], d.qpos[servo.qpos + 1], d.qpos[servo.qpos + 2], d.qpos[servo.qpos + 3]);
      const Eigen::AngleAxisd rotation(now.conjugate() * Quaterniond(desired.rotation[0], desired.rotation[1],
                                                                     desired.rotation[2], desired.rotation[3]));
      const double angle = rotation.angle() > M_PI ? rotation.angle() - 2. * M_PI : rotation.angle();
      for (int k = 0; k < 3; ++k)
        desired_acceleration_[std::size_t(servo.dof + k)] =
            w * w * angle * rotation.axis()[k] - 2. * w * d.qvel[servo.dof + k];
    } else if (!servo.gains) {
      desired_acceleration_[std::size_t(servo.dof)] = desired.acceleration +
                                                      2. * w * (desired.velocity - d.qvel[servo.dof]) +
                                                      w * w * (desired.position - d.qpos[servo.qpos]);
    }
  }
  physics().mj_mulM(&m, &d, torque_.data(), desired_acceleration_.data());
  const bool direct = reference_.mode() == ControlMode::torque;
  for (std::size_t i = 0; i < model_->servos.size(); ++i) {
    const Servo& servo = model_->servos[i];
    const int dofs = servo.kind == MotionKind::quaternion ? 3 : 1;
    for (int k = servo.dof; k < servo.dof + dofs; ++k) {
      double torque = torque_[std::size_t(k)];
      if (direct && servo.q >= 0) {
        torque = reference_.torque()[long(i)];
      } else {
        if (servo.gains && dofs == 1) {
          // stiffness and damping at the end of the step (implicit), stable for any gain
          const double kp = servo.gains->first, kd = servo.gains->second;
          const double error = references[i].position - d.qpos[servo.qpos], rate = references[i].velocity - d.qvel[k];
          const double inertia = d.M[m.M_rowadr[k] + m.M_rownnz[k] - 1];
          torque = (kp * (error + h * rate) + kd * rate) / (1. + (h * kd + h * h * kp) / inertia);
        }
        torque += d.qfrc_bias[k] - d.qfrc_passive[k];
      }
      d.qfrc_applied[k] = std::clamp(torque, -servo.effort, servo.effort);
    }
  }
}

void World::moveGrippers(double h) {
  mjData& d = *data_;
  for (std::size_t g = 0; g < grippers_.size(); ++g) {
    const GripperJoint& gripper = model_->grippers[g];
    GripperTask& task = grippers_[g];
    const double travel = task.speed * h;
    task.reference += std::clamp(task.target - task.reference, -travel, travel);
    double length = 0., speed = 0.;
    for (std::size_t i = 0; i < gripper.qpos.size(); ++i) {
      length += gripper.coefficient / gripper.ratio[i] * d.qpos[gripper.qpos[i]];
      speed += gripper.coefficient / gripper.ratio[i] * d.qvel[gripper.dof[i]];
    }
    const double reach = task.force * double(gripper.qpos.size()) / gripper.stiffness;
    const double control = std::clamp(task.reference, length - reach, length + reach);
    d.ctrl[gripper.actuator] = control;
    const bool pushes = control != task.reference || task.reference == task.target;
    task.still = pushes && std::abs(speed) < kStill ? task.still + h : 0.;
  }
}

bool World::diverges() const {
  const auto& warning = data_->warning;
  return warning[mjWARN_BADQPOS].number > 0 || warning[mjWARN_BADQVEL].number > 0 || warning[mjWARN_BADQACC].number > 0;
}

void World::checkNumbers(double time) {
  const auto& warning = data_->warning;
  const bool full = warning[mjWARN_CONTACTFULL].number > 0 || warning[mjWARN_CNSTRFULL].number > 0;
  if (!full && !diverges()) return;
  setState(before_);
  contact_search_ = ContactSearch(*physics_);
  if (full) throw Error("Simulation.step: the contacts exceed the memory; the state before the step is restored");
  throw DivergenceError(
      cat("Simulation.step: the simulation diverges before ", time,
          " s; the state before the step is restored. Possible causes: tiny masses, deep overlaps, large torques"));
}

}  // namespace kinegraph::inline simulation_internal
