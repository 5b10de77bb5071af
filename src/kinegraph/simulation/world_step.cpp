#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/rendering/mujoco.h"
#include "kinegraph/simulation/world.h"

namespace kinegraph {

namespace {

constexpr double kStill = 1e-3;       ///< m/s: fingers that are slower do not move
constexpr double kLongestStep = 1e4;  ///< s, of a call

bool hasSurfaceVelocity(const mjModel& m, int geom) {
  const mjtNum* velocity = m.geom_surfacevel + 6 * geom;
  return std::any_of(velocity, velocity + 6, [](mjtNum v) { return v != 0.; });
}

/// MuJoCo's, for solimp with the midpoint .5 and the power 2, which all contacts here have.
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
    throw ValueError(cat("Simulation.step: u_control has ", u.size(), " numbers; mode ", controlModeName(mode),
                         size == 0 ? " takes none" : cat(" takes ", size, ", the joints' ", model_->dofs, " dofs")));
  if (!u.allFinite())
    throw ValueError(cat("Simulation.step: u_control has numbers that are not finite: ", u.transpose()));
  if (mode == ControlMode::velocity || mode == ControlMode::acceleration || mode == ControlMode::torque) {
    for (const Servo& servo : model_->drives) {
      if (servo.q >= 0 && (servo.kind == MotionKind::quaternion || servo.kind == MotionKind::circle))
        throw ValueError(cat("Simulation.step: mode ", controlModeName(mode),
                             " is not for the joint whose numbers begin at ", servo.q,
                             ": they are those of a quaternion; use mode position"));
    }
  }
}

void World::step(const VectorXd& u, double tau, ControlMode mode, const CancellationToken& cancellation) {
  checkCommand(u, tau, mode);
  const MujocoErrors thrown;
  const WorldState before = state();
  try {
    const int steps = std::max(1, int(std::ceil(tau / options_.inner_step - 1e-9)));
    const double h = tau / steps, start = data_->time;
    physics_->opt.timestep = h;
    too_fast_.clear();
    reference_.command(*model_, u, tau, mode, options_);
    for (int i = 0; i < steps; ++i) {
      cancellation.check();
      if (!is_kinematic_) reference_.stayNear(*model_, data_->qpos, data_->qvel);
      reference_.prepare(*model_, data_->time, h, i + 1 == steps, options_);
      is_kinematic_ ? followReferences(h) : innerStep(h);
      reference_.shift(h);
    }
    data_->time = start + tau;
    if (mode == ControlMode::torque) reference_.hold(*model_, data_->qpos, data_->qvel);
  } catch (...) {
    setState(before);
    throw;
  }
  checkNumbers(before, data_->time);
  is_computed_ = !is_kinematic_;
  copy_is_computed_ = false;
}

/// Joints are where they shall be, and what is attached goes with them.
void World::followReferences(double h) {
  mjData& d = *data_;
  for (std::size_t i = 0; i < model_->drives.size(); ++i) {
    const Servo& servo = model_->drives[i];
    if (servo.kind == MotionKind::quaternion) {
      std::copy_n(reference_.dofs()[i].turn, 4, d.qpos + servo.qpos);
    } else {
      d.qpos[servo.qpos] = reference_.next(i);
      d.qvel[servo.dof] = (reference_.next(i) - reference_.dofs()[i].position) / h;
    }
  }
  for (std::size_t g = 0; g < grippers_.size(); ++g) {
    GripperTask& task = grippers_[g];
    const double way = task.speed * h;
    task.reference += std::clamp(task.target - task.reference, -way, way);
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
  mj.mj_fwdPosition(m, d);
  if (d->ncon > 0) {
    mj.mj_comVel(m, d);
    correctContacts(h);
  }
  mj.mj_sensorPos(m, d);
  mj.mj_fwdVelocity(m, d);
  mj.mj_sensorVel(m, d);
  driveMotors(h);
  turning_.apply(*m, *d, h);
  if (const int id = turning_.tooFast(); id != 0) too_fast_.insert(model_->body_of_id[std::size_t(id)]);
  if (pull_.body != 0) addPull();
  mj.mj_step2(m, d);
  if (pull_.body != 0) removePull();
}

/// MuJoCo leaves the term dJ/dt v out of the rows of contacts, so that what friction holds in a turning hand slips, and
/// its step lets positions drift by h^2/2 of it. Both vanish with the velocity v* = (1/b + h/2) t (a2 - a1) along the
/// tangents t, where a_i is the acceleration of the touching point of body i at zero acceleration of the joints, and
/// b = 2 / (dmax timeconst); and along the normal with another distance, which counts the drift of a step, too: MuJoCo
/// asks for the force that belongs to the distance at the end of the step.
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
    const Vector3d turn = Vector(V), velocity = Vector(V + 3) + turn.cross(r);
    return Vector(A + 3) + Vector(A).cross(r) + turn.cross(velocity);
  };
  for (int i = 0; i < d.ncon; ++i) {
    mjContact& contact = d.contact[i];
    if (contact.efc_address < 0 || contact.dim < 3) continue;
    const Vector point(contact.pos);
    const Vector3d missing =
        acceleration(m.geom_bodyid[contact.geom[1]], point) - acceleration(m.geom_bodyid[contact.geom[0]], point);
    const double factor = .5 * contact.solimp[1] * contact.solref[0] + .5 * h;
    // MuJoCo fills in the velocities of surfaces that have one, and leaves those of others as they are in memory
    if (!hasSurfaceVelocity(m, contact.geom[0]) && !hasSurfaceVelocity(m, contact.geom[1]))
      std::fill_n(contact.surfacevel, 3, 0.);
    contact.surfacevel[0] += factor * Vector(contact.frame + 3).dot(missing);
    contact.surfacevel[1] += factor * Vector(contact.frame + 6).dot(missing);
    // the normal has no velocity to set: a change of the distance does the same
    const double dmax = contact.solimp[1], b = 2. / (dmax * contact.solref[0]);
    const double k = 1. / (dmax * dmax * contact.solref[0] * contact.solref[0] * contact.solref[1] * contact.solref[1]);
    const double shift = (1. + .5 * h * b) / (k * impedance(contact)) + .5 * h * h;
    d.efc_pos[contact.efc_address] += Vector(contact.frame).dot(missing) * shift;
  }
}

/// tau = M (a_ref + 2 w (v_ref - v) + w^2 (p_ref - p)) + bias - passive, within the motor's limit.
void World::driveMotors(double h) {
  const mjModel& m = *physics_;
  mjData& d = *data_;
  const double w = options_.servo_frequency;
  std::fill(wanted_.begin(), wanted_.end(), 0.);
  const auto& references = reference_.dofs();
  for (std::size_t i = 0; i < model_->drives.size(); ++i) {
    const Servo& servo = model_->drives[i];
    const Reference::Dof& wanted = references[i];
    if (servo.kind == MotionKind::quaternion) {
      const Quaterniond now(d.qpos[servo.qpos], d.qpos[servo.qpos + 1], d.qpos[servo.qpos + 2], d.qpos[servo.qpos + 3]);
      const Eigen::AngleAxisd turn(now.conjugate() *
                                   Quaterniond(wanted.turn[0], wanted.turn[1], wanted.turn[2], wanted.turn[3]));
      const double angle = turn.angle() > M_PI ? turn.angle() - 2. * M_PI : turn.angle();
      for (int k = 0; k < 3; ++k)
        wanted_[std::size_t(servo.dof + k)] = w * w * angle * turn.axis()[k] - 2. * w * d.qvel[servo.dof + k];
    } else if (!servo.gains) {
      wanted_[std::size_t(servo.dof)] = wanted.acceleration + 2. * w * (wanted.velocity - d.qvel[servo.dof]) +
                                        w * w * (wanted.position - d.qpos[servo.qpos]);
    }
  }
  physics().mj_mulM(&m, &d, torque_.data(), wanted_.data());
  const bool direct = reference_.mode() == ControlMode::torque;
  for (std::size_t i = 0; i < model_->drives.size(); ++i) {
    const Servo& servo = model_->drives[i];
    const int dofs = servo.kind == MotionKind::quaternion ? 3 : 1;
    for (int k = servo.dof; k < servo.dof + dofs; ++k) {
      double torque = torque_[std::size_t(k)];
      if (direct && servo.q >= 0) {
        torque = reference_.torque()[long(i)];
      } else {
        if (servo.gains && dofs == 1) {
          // stiffness and damping at the end of the step, so that no gain is too large for it
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
    const double way = task.speed * h;
    task.reference += std::clamp(task.target - task.reference, -way, way);
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

void World::checkNumbers(const WorldState& before, double time) {
  const auto& warning = data_->warning;
  const bool full = warning[mjWARN_CONTACTFULL].number > 0 || warning[mjWARN_CNSTRFULL].number > 0;
  const bool bad =
      warning[mjWARN_BADQPOS].number > 0 || warning[mjWARN_BADQVEL].number > 0 || warning[mjWARN_BADQACC].number > 0;
  if (!full && !bad) return;
  setState(before);
  if (full)
    throw Error("Simulation.step: more contacts at once than there is memory for; the state is as before the step");
  throw Error(
      cat("Simulation.step: numbers leave all bounds before ", time,
          " s; the state is as before the step. Look for tiny masses, things that overlap much, or large torques"));
}

}  // namespace kinegraph
