#include "kinegraph/simulation/model_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline simulation_internal {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

class ModelIndex {
 public:
  ModelIndex(const ModelParts& parts, const std::vector<ModelShapes::Geom>& geoms, const KinematicModel& kinematics,
             SceneModel& model)
      : parts_(parts), geoms_(geoms), kinematics_(kinematics), model_(model) {}

  void index() {
    const mjModel& m = *model_.model;
    model_.body_of_id.assign(std::size_t(m.nbody), 0);
    for (std::size_t b = 0; b < parts_.bodies.size(); ++b) {
      model_.body_id.push_back(mj_.mjs_getId(parts_.bodies[b]->element));
      model_.body_of_id[std::size_t(model_.body_id.back())] = int(b);
    }
    model_.geom_frame.assign(std::size_t(m.ngeom), -1);
    model_.geom_takes_largest.assign(std::size_t(m.ngeom), false);
    model_.geom_restitution.assign(std::size_t(m.ngeom), 0.);
    for (const ModelShapes::Geom& geom : geoms_) {
      const auto id = std::size_t(mj_.mjs_getId(geom.spec->element));
      model_.geom_frame[id] = geom.frame;
      model_.geom_takes_largest[id] = geom.largest;
      model_.geom_restitution[id] = geom.restitution;
    }
    indexFree(m);
    indexJoints(m);
    indexGrippers(m);
    for (std::size_t i = 0, s = 0; i < model_.force_sensors.size(); ++i, s += 2)
      model_.force_sensors[i].address = m.sensor_adr[mj_.mjs_getId(parts_.sensors[s]->element)];
    for (std::size_t i = 0; i < model_.accelerometers.size(); ++i)
      model_.accelerometers[i].address =
          m.sensor_adr[mj_.mjs_getId(parts_.sensors[2 * model_.force_sensors.size() + i]->element)];
  }

 private:
  void indexFree(const mjModel& m) {
    for (std::size_t b = 1; b < model_.scene.bodies.size(); ++b) {
      if (model_.scene.bodies[b].kind != SceneBody::Kind::free) continue;
      const int joint = m.body_jntadr[model_.body_id[b]];
      model_.free_frames.push_back(model_.scene.bodies[b].frame->id);
      model_.free_qpos.push_back(m.jnt_qposadr[joint]);
      model_.free_dof.push_back(m.jnt_dofadr[joint]);
    }
  }

  ModelStep indexed(const mjModel& m, const std::pair<MotionKind, mjsJoint*>& step) const {
    if (!step.second) return {step.first, -1, -1};
    const int id = mj_.mjs_getId(step.second->element);
    return {step.first, m.jnt_qposadr[id], m.jnt_dofadr[id]};
  }

  void indexJoints(const mjModel& m) {
    for (const ModelParts::MadeJoint& made : parts_.joints) {
      const FrameData& frame = *made.frame;
      const FrameData& source = dofSource(frame);
      if (frame.joint->mimic) {
        const ModelParts::MadeJoint& from = parts_.joint(source);
        for (std::size_t i = 0; i < made.steps.size(); ++i) {
          if (!isScalar(made.steps[i].first)) continue;
          const ModelStep a = indexed(m, made.steps[i]), b = indexed(m, from.steps[i]);
          model_.followers.push_back({a.qpos, a.dof, b.qpos, b.dof, motionRatio(frame, source)});
        }
        continue;
      }
      ModelJoint joint;
      joint.frame = frame.id;
      joint.dofs = frame.joint->dofs();
      joint.scale = motionScale(frame);
      if (frame.joint->active) joint.first_q = kinematics_.frame_dofs[std::size_t(frame.id)].first;
      for (const auto& step : made.steps) joint.steps.push_back(indexed(m, step));
      model_.joints.push_back(joint);
      const bool gripper = isFingerJoint(frame) && !parts_.followersOf(frame).empty();
      if (!gripper && !attributeFlag(frame, "noMotor", false)) addServos(frame, m);
      if (!gripper && attributeFlag(frame, "noMotor", false)) addSprings(made, *model_.model);
    }
  }

  /// Takes over the springs of a joint from MuJoCo.
  void addSprings(const ModelParts::MadeJoint& made, mjModel& m) {
    for (const auto& step : made.steps) {
      if (!step.second || !isScalar(step.first) || step.second->stiffness[0] <= 0.) continue;
      const int id = mj_.mjs_getId(step.second->element), dof = m.jnt_dofadr[id], qpos = m.jnt_qposadr[id];
      const double stiffness = step.second->stiffness[0], h = m.opt.timestep;
      if (stiffness * h * h > .25 * m.dof_M0[dof]) continue;
      model_.springs.push_back({qpos, dof, stiffness, m.qpos_spring[qpos]});
      m.jnt_stiffness[id] = 0.;
    }
  }

  void addServos(const FrameData& frame, const mjModel& m) {
    const ModelJoint& joint = model_.joints.back();
    int q = 0;
    for (std::size_t i = 0; i < joint.steps.size(); ++i) {
      const ModelStep& step = joint.steps[i];
      if (step.dof >= 0) {
        Servo servo;
        servo.joint = int(model_.joints.size()) - 1;
        servo.qpos = step.qpos;
        servo.dof = step.dof;
        servo.q = joint.first_q < 0 ? -1 : joint.first_q + q;
        servo.kind = step.kind;
        servo.scale = joint.scale;
        servo.friction = attributeNumber(frame, "jointFriction", 0.);
        setMotor(servo, frame, m.dof_M0[step.dof]);
        model_.servos.push_back(servo);
      }
      q += frame.joint->steps[i].dofs();
    }
  }

  /// `inertia`: of the motion in the reference configuration, kg m^2 or kg.
  static void setMotor(Servo& servo, const FrameData& frame, double inertia) {
    const Node* node = frame.attributes->find("ctrl_limits");
    const NumberArray* limits = node ? node->value.as<NumberArray>() : nullptr;
    const auto limit = [&](std::size_t i) {
      return limits && limits->numbers.size() > i && limits->numbers[i] > 0. ? limits->numbers[i] : kInfinite;
    };
    servo.velocity = limit(0);
    servo.effort = std::min(limit(1), attributeNumber(frame, "motorLimit", kInfinite));
    if (frame.attributes->find("motorLambda")) {
      const double lambda = attributeNumber(frame, "motorLambda", 1.), mass = attributeNumber(frame, "motorMass", 1.);
      if (!(lambda > 0.)) throw ValueError(cat("Simulation: frame '", frame.name, "': motorLambda must be positive"));
      servo.gains = {mass / (lambda * lambda), 2. * mass / lambda};
    } else if (frame.attributes->find("motorKp")) {
      servo.gains = {attributeNumber(frame, "motorKp", 0.), attributeNumber(frame, "motorKd", 0.)};
      if (!(servo.gains->first >= 0.) || !(servo.gains->second >= 0.))
        throw ValueError(cat("Simulation: frame '", frame.name, "': motorKp and motorKd must not be negative"));
      const double ratio = attributeNumber(frame, "motorDampingRatio", 0.);
      if (ratio > 0.) servo.gains->second = 2. * ratio * std::sqrt(servo.gains->first * inertia);
    }
  }

  void indexGrippers(const mjModel& m) {
    for (std::size_t g = 0; g < model_.grippers.size(); ++g) {
      GripperJoint& gripper = model_.grippers[g];
      const FrameData& frame = *parts_.grippers[g].front();
      gripper.actuator = int(g);
      for (std::size_t j = 0; j < model_.joints.size(); ++j) {
        if (model_.joints[j].frame == frame.id) gripper.joint = int(j);
      }
      for (const FrameData* each : parts_.grippers[g]) {
        const ModelStep step = indexed(m, parts_.joint(*each).steps[0]);
        gripper.qpos.push_back(step.qpos);
        gripper.dof.push_back(step.dof);
        gripper.ratio.push_back(motionRatio(*each, frame));
      }
      const mjsJoint* joint = parts_.joint(frame).steps[0].second;
      gripper.lower = joint->limited == mjLIMITED_TRUE ? joint->range[0] : -kInfinite;
      gripper.upper = joint->limited == mjLIMITED_TRUE ? joint->range[1] : kInfinite;
    }
  }

  const Physics& mj_ = physics();
  const ModelParts& parts_;
  const std::vector<ModelShapes::Geom>& geoms_;
  const KinematicModel& kinematics_;
  SceneModel& model_;
};

}  // namespace

const ModelParts::MadeJoint& ModelParts::joint(const FrameData& frame) const {
  return *std::find_if(joints.begin(), joints.end(), [&](const MadeJoint& j) { return j.frame == &frame; });
}

std::vector<const FrameData*> ModelParts::followersOf(const FrameData& source) const {
  std::vector<const FrameData*> found;
  for (const MadeJoint& joint : joints) {
    if (joint.frame->joint->mimic && &dofSource(*joint.frame) == &source) found.push_back(joint.frame);
  }
  return found;
}

bool isScalar(MotionKind kind) {
  return kind == MotionKind::translate || kind == MotionKind::rotate || kind == MotionKind::rotateAbout;
}

bool isFingerJoint(const FrameData& frame) {
  const Joint& joint = *frame.joint;
  return !joint.active && !joint.mimic && joint.dofs() == 1 && isScalar(joint.steps.front().kind);
}

double motionRatio(const FrameData& follower, const FrameData& source) {
  return motionScale(follower) / motionScale(source);
}

void indexModel(const ModelParts& parts, const std::vector<ModelShapes::Geom>& geoms, const KinematicModel& kinematics,
                SceneModel& model) {
  ModelIndex(parts, geoms, kinematics, model).index();
}

}  // namespace kinegraph::inline simulation_internal
