#include "kinegraph/simulation/reference.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/text.h"

namespace kinegraph::inline simulation_internal {

namespace {

constexpr double kMaxLead = .05;  ///< rad or m

bool isBall(const Servo& servo) { return servo.kind == MotionKind::quaternion; }

/// Converts a servo's entries in a vector of the scene's q to its motion.
double motionOf(const Servo& servo, const double* u, double near) {
  if (servo.kind != MotionKind::circle) return servo.scale * u[servo.q];
  const double angle = 2. * std::atan2(u[servo.q + 1], u[servo.q]);
  return angle + 2. * M_PI * std::round((near - angle) / (2. * M_PI));
}

}  // namespace

int controlSize(ControlMode mode, int dofs) {
  switch (mode) {
    case ControlMode::none:
    case ControlMode::spline:
      return 0;
    case ControlMode::positionVelocity:
      return 2 * dofs;
    default:
      return dofs;
  }
}

const char* controlModeName(ControlMode mode) {
  switch (mode) {
    case ControlMode::none:
      return "none";
    case ControlMode::position:
      return "position";
    case ControlMode::velocity:
      return "velocity";
    case ControlMode::acceleration:
      return "acceleration";
    case ControlMode::positionVelocity:
      return "positionVelocity";
    case ControlMode::spline:
      return "spline";
    case ControlMode::torque:
      return "torque";
  }
  return "";
}

void Reference::holdAt(const SceneModel& model, const mjtNum* qpos, const mjtNum* qvel) {
  parts_.dofs.assign(model.servos.size(), {});
  parts_.courses.assign(model.servos.size(), {});
  parts_.torque = VectorXd::Zero(long(model.servos.size()));
  parts_.next.assign(model.servos.size(), 0.);
  parts_.clock.mode = ControlMode::none;
  for (std::size_t i = 0; i < parts_.dofs.size(); ++i) {
    const Servo& servo = model.servos[i];
    if (isBall(servo)) {
      std::copy_n(qpos + servo.qpos, 4, parts_.dofs[i].rotation);
    } else {
      parts_.dofs[i].position = parts_.dofs[i].goal = qpos[servo.qpos];
      parts_.dofs[i].velocity = parts_.dofs[i].rate = parts_.dofs[i].slope = qvel[servo.dof];
    }
  }
}

void Reference::courseOf(std::size_t i, const Servo& servo, double goal, double tau, const SimulationOptions& options) {
  Dof& dof = parts_.dofs[i];
  dof.goal = goal;
  const double slope = (goal - dof.position) / tau;
  if (std::abs(slope - dof.slope) > options.reference_acceleration * tau || std::abs(slope) > servo.velocity) {
    parts_.courses[i].path = Path::limited;
    return;
  }
  parts_.courses[i] = {Path::cubic, dof.position, dof.rate, 1.5 * slope - .5 * dof.slope};
  dof.slope = slope;
}

void Reference::command(const SceneModel& model, const VectorXd& u, double tau, ControlMode mode,
                        const SimulationOptions& options, bool exact) {
  parts_.clock.mode = mode;
  parts_.clock.tau = tau;
  parts_.clock.elapsed = 0.;
  for (std::size_t i = 0; i < parts_.dofs.size(); ++i) {
    const Servo& servo = model.servos[i];
    Dof& dof = parts_.dofs[i];
    Course& course = parts_.courses[i];
    if (mode == ControlMode::none || servo.q < 0) {
      course.path = dof.position == dof.goal ? Path::still : Path::limited;
    } else if (mode == ControlMode::position || mode == ControlMode::positionVelocity) {
      if (isBall(servo)) {
        std::copy_n(wxyz(unitQuaternion(u.segment<4>(servo.q), "a joint's quaternion")).data(), 4, dof.rotation);
      } else if (mode == ControlMode::position && exact) {
        dof.goal = motionOf(servo, u.data(), dof.position);
        const double slope = (dof.goal - dof.position) / tau;
        course = {Path::cubic, dof.position, slope, slope};
      } else if (mode == ControlMode::position) {
        courseOf(i, servo, motionOf(servo, u.data(), dof.position), tau, options);
      } else {
        course = {Path::cubic, dof.position, dof.rate, servo.scale * u[model.dofs + servo.q]};
        dof.goal = motionOf(servo, u.data(), dof.position);
      }
    } else if (mode == ControlMode::velocity) {
      course = {Path::constant_velocity, dof.position, dof.velocity, servo.scale * u[servo.q]};
    } else if (mode == ControlMode::acceleration) {
      course = {Path::constant_acceleration, 0., 0., servo.scale * u[servo.q]};
    } else if (mode == ControlMode::spline) {
      course.path = Path::still;
    } else if (mode == ControlMode::torque) {
      course.path = Path::still;
      parts_.torque[long(i)] = u[servo.q] / servo.scale;
    }
  }
}

/// Returns the next position of a reference that approaches a distant goal, fast but able to stop there in steps of h.
double Reference::limitedStep(const Dof& dof, const Servo& servo, double h, const SimulationOptions& options) {
  const double a = options.reference_acceleration, left = dof.goal - dof.position, half = .5 * a * h;
  double speed = std::min(servo.velocity, std::sqrt(2. * a * std::abs(left) + half * half) - half);
  speed = std::copysign(std::min(speed, std::abs(left) / h), left);
  const double velocity = std::clamp(speed, dof.velocity - a * h, dof.velocity + a * h);
  const double next = dof.position + h * velocity;
  return std::abs(dof.goal - next) <= 1e-12 ? dof.goal : next;
}

double Reference::nextPosition(std::size_t i, const Servo& servo, double h, const SimulationOptions& options) {
  Dof& dof = parts_.dofs[i];
  const Course& course = parts_.courses[i];
  const double s = parts_.clock.elapsed / parts_.clock.tau;
  switch (course.path) {
    case Path::still:
      return dof.position;
    case Path::limited:
      return limitedStep(dof, servo, h, options);
    case Path::constant_velocity:
      return dof.goal = course.start + parts_.clock.elapsed * course.end_velocity;
    case Path::constant_acceleration: {
      dof.goal = dof.position + h * (dof.rate + .5 * h * course.end_velocity);
      dof.rate += h * course.end_velocity;
      return dof.goal;
    }
    case Path::cubic: {
      if (parts_.clock.last) return dof.goal;
      const double d = dof.goal - course.start, v0 = course.start_velocity * parts_.clock.tau,
                   v1 = course.end_velocity * parts_.clock.tau;
      return course.start + s * (v0 + s * (3. * d - 2. * v0 - v1 + s * (v0 + v1 - 2. * d)));
    }
  }
  return dof.position;
}

void Reference::nextOfSpline(const SceneModel& model, double time) {
  const VectorXd q = spline.eval(time - spline_start, 0);
  for (std::size_t i = 0; i < parts_.dofs.size(); ++i) {
    const Servo& servo = model.servos[i];
    if (servo.q < 0) continue;
    if (isBall(servo)) {
      std::copy_n(wxyz(unitQuaternion(q.segment<4>(servo.q), "a spline's quaternion")).data(), 4,
                  parts_.dofs[i].rotation);
    } else {
      parts_.dofs[i].goal = parts_.next[i] = motionOf(servo, q.data(), parts_.dofs[i].position);
    }
  }
}

void Reference::stayNear(const SceneModel& model, const mjtNum* qpos, const mjtNum* qvel) {
  for (std::size_t i = 0; i < parts_.dofs.size(); ++i) {
    Course& course = parts_.courses[i];
    const bool accelerates = course.path == Path::constant_acceleration;
    if (course.path != Path::constant_velocity && !accelerates) continue;
    const Servo& servo = model.servos[i];
    Dof& dof = parts_.dofs[i];
    const double lead = dof.position - qpos[servo.qpos];
    if (std::abs(lead) <= kMaxLead) continue;
    const double back = std::copysign(kMaxLead, lead) - lead;
    dof.position += back;
    course.start += back;
    if (accelerates) dof.rate = dof.velocity = qvel[servo.dof];
  }
}

void Reference::prepare(const SceneModel& model, double time, double h, bool last, const SimulationOptions& options) {
  parts_.clock.elapsed += h;
  parts_.clock.last = last;
  for (std::size_t i = 0; i < parts_.dofs.size(); ++i)
    parts_.next[i] = isBall(model.servos[i]) ? 0. : nextPosition(i, model.servos[i], h, options);
  if (parts_.clock.mode == ControlMode::spline && !spline.isEmpty()) nextOfSpline(model, time + h);
  for (std::size_t i = 0; i < parts_.dofs.size(); ++i)
    parts_.dofs[i].acceleration = ((parts_.next[i] - parts_.dofs[i].position) / h - parts_.dofs[i].velocity) / h;
}

void Reference::shift(double h) {
  for (std::size_t i = 0; i < parts_.dofs.size(); ++i) {
    Dof& dof = parts_.dofs[i];
    dof.velocity = (parts_.next[i] - dof.position) / h;
    dof.position = parts_.next[i];
    if (parts_.courses[i].path == Path::cubic) {
      if (parts_.clock.last) dof.rate = parts_.courses[i].end_velocity;
    } else {
      if (parts_.courses[i].path != Path::constant_acceleration) dof.rate = dof.velocity;
      dof.slope = dof.velocity;
    }
  }
}

}  // namespace kinegraph::inline simulation_internal
