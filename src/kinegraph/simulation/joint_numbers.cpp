#include <cmath>

#include "kinegraph/simulation/scene_model.h"

namespace kinegraph::inline simulation_internal {

void readJoint(const ModelJoint& joint, const mjtNum* qpos, double* q) {
  for (const ModelStep& step : joint.steps) {
    switch (step.kind) {
      case MotionKind::quaternion:
        for (int i = 0; i < 4; ++i) *q++ = qpos[step.qpos + i];
        break;
      case MotionKind::circle:
        *q++ = std::cos(.5 * qpos[step.qpos]);
        *q++ = std::sin(.5 * qpos[step.qpos]);
        break;
      case MotionKind::time:
        ++q;
        break;
      default:
        *q++ = qpos[step.qpos] / joint.scale;
    }
  }
}

void writeJoint(const ModelJoint& joint, const double* q, mjtNum* qpos) {
  for (const ModelStep& step : joint.steps) {
    switch (step.kind) {
      case MotionKind::quaternion: {
        const Vector4d unit = unitQuaternion(Vector4d(q[0], q[1], q[2], q[3])).coeffs();
        qpos[step.qpos] = unit[3];
        for (int i = 0; i < 3; ++i) qpos[step.qpos + 1 + i] = unit[i];
        q += 4;
        break;
      }
      case MotionKind::circle: {
        // the angle modulo 2 pi that is closest to the present one
        const double angle = 2. * std::atan2(q[1], q[0]);
        qpos[step.qpos] = angle + 2. * M_PI * std::round((qpos[step.qpos] - angle) / (2. * M_PI));
        q += 2;
        break;
      }
      case MotionKind::time:
        ++q;
        break;
      default:
        qpos[step.qpos] = joint.scale * *q++;
    }
  }
}

void readJointVelocity(const ModelJoint& joint, const mjtNum* qpos, const mjtNum* qvel, double* velocity) {
  for (const ModelStep& step : joint.steps) {
    switch (step.kind) {
      case MotionKind::quaternion: {
        const mjtNum* p = qpos + step.qpos;
        const Quaterniond rate = Quaterniond(p[0], p[1], p[2], p[3]) *
                                 Quaterniond(0., qvel[step.dof], qvel[step.dof + 1], qvel[step.dof + 2]);
        for (const double part : {rate.w(), rate.x(), rate.y(), rate.z()}) *velocity++ = .5 * part;
        break;
      }
      case MotionKind::circle:
        *velocity++ = -.5 * std::sin(.5 * qpos[step.qpos]) * qvel[step.dof];
        *velocity++ = .5 * std::cos(.5 * qpos[step.qpos]) * qvel[step.dof];
        break;
      case MotionKind::time:
        *velocity++ = 0.;
        break;
      default:
        *velocity++ = qvel[step.dof] / joint.scale;
    }
  }
}

void writeJointVelocity(const ModelJoint& joint, const double* q, const double* velocity, mjtNum* qvel) {
  for (const ModelStep& step : joint.steps) {
    switch (step.kind) {
      case MotionKind::quaternion: {
        const Quaterniond rate = Quaterniond(q[0], q[1], q[2], q[3]).conjugate() *
                                 Quaterniond(velocity[0], velocity[1], velocity[2], velocity[3]);
        qvel[step.dof] = 2. * rate.x();
        qvel[step.dof + 1] = 2. * rate.y();
        qvel[step.dof + 2] = 2. * rate.z();
        q += 4;
        velocity += 4;
        break;
      }
      case MotionKind::circle:
        qvel[step.dof] = 2. * (q[0] * velocity[1] - q[1] * velocity[0]);
        q += 2;
        velocity += 2;
        break;
      case MotionKind::time:
        ++q;
        ++velocity;
        break;
      default:
        qvel[step.dof] = joint.scale * *velocity++;
        ++q;
    }
  }
}

Pose readFreePose(const mjtNum* qpos) {
  return {Vector3d(qpos[0], qpos[1], qpos[2]), Quaterniond(qpos[3], qpos[4], qpos[5], qpos[6])};
}

void writeFreePose(const Pose& pose, mjtNum* qpos) {
  for (int i = 0; i < 3; ++i) qpos[i] = pose.p[i];
  const Vector4d rotation = wxyz(pose.q);
  for (int i = 0; i < 4; ++i) qpos[3 + i] = rotation[i];
}

}  // namespace kinegraph::inline simulation_internal
