#include "kinegraph/kinematics/state.h"

#include <cmath>

namespace kinegraph {

namespace {

/// R <- R * rotation about coordinate axis `axis`: only two columns change.
void rotateColumns(Matrix3d& R, int axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const int i = axis == 2 ? 0 : axis + 1, j = axis == 0 ? 2 : axis - 1;
  const Vector3d a = R.col(i), b = R.col(j);
  R.col(i) = c * a + s * b;
  R.col(j) = c * b - s * a;
}

}  // namespace

State::State(std::shared_ptr<const Program> program, std::shared_ptr<const Parameters> parameters)
    : program_(std::move(program)),
      parameters_(std::move(parameters)),
      q_(program_->home),
      link_pose_(program_->links.size()),
      twists_(program_->column_dof.size()) {
  update();
}

void State::setJoints(const double* q) {
  q_ = Eigen::Map<const VectorXd>(q, program_->dofs);
  update();
}

void State::setParameters(std::shared_ptr<const Parameters> parameters) {
  parameters_ = std::move(parameters);
  update();
}

void State::update() {
  using Kind = MotionStep::Kind;
  const Program& program = *program_;
  for (std::size_t l = 1; l < program.links.size(); ++l) {
    const Program::Link& link = program.links[l];
    RigidTransform X = link_pose_[link.parent] * parameters_->joint_base[l];
    const double* q = q_.data() + link.dof;
    Twist* twist = twists_.data() + link.first_column;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      const MotionStep& step = program.steps[s];
      const double factor = step.sign * link.scale;
      switch (step.kind) {
        case Kind::translate: {
          twist->angular.setZero();
          twist->linear = factor * X.R.col(step.axis);
          X.p += *q * twist->linear;
          break;
        }
        case Kind::rotate: {
          twist->angular = factor * X.R.col(step.axis);
          twist->linear = X.p.cross(twist->angular);
          rotateColumns(X.R, step.axis, factor * *q);
          break;
        }
        case Kind::rotateAbout: {
          twist->angular = factor * (X.R * link.axis);
          twist->linear = X.p.cross(twist->angular);
          X.R = X.R * Eigen::AngleAxisd(factor * *q, link.axis).toRotationMatrix();
          break;
        }
        case Kind::quaternion: {
          // w = 2 vec(dq * conj(q)) / |q|: the component of dq along q only changes the norm.
          const Quaterniond raw(q[0], q[1], q[2], q[3]);
          const double norm = std::max(raw.norm(), 1e-100);
          const Quaterniond unit(raw.coeffs() / norm);
          const Vector3d v = unit.vec();
          twist[0].angular = -2. / norm * (X.R * v);
          for (int k = 0; k < 3; ++k) {
            const Vector3d e = Vector3d::Unit(k);
            twist[k + 1].angular = 2. / norm * (X.R * (unit.w() * e - e.cross(v)));
          }
          for (int k = 0; k < 4; ++k) twist[k].linear = X.p.cross(twist[k].angular);
          X.R = X.R * unit.toRotationMatrix();
          break;
        }
        case Kind::circle: {
          const double square = std::max(q[0] * q[0] + q[1] * q[1], 1e-100);
          twist[0].angular = -2. * q[1] / square * X.R.col(2);
          twist[1].angular = 2. * q[0] / square * X.R.col(2);
          for (int k = 0; k < 2; ++k) twist[k].linear = X.p.cross(twist[k].angular);
          rotateColumns(X.R, 2, 2. * std::atan2(q[1], q[0]));
          break;
        }
        case Kind::time: {
          twist->angular.setZero();
          twist->linear.setZero();
          break;
        }
      }
      q += step.dofs();
      twist += step.dofs();
    }
    link_pose_[l] = X;
  }
}

void State::addPointJacobian(int frame, const Vector3d& p_WQ, double factor, JacobianRows J) const {
  for (int c = program_->last_column[link(frame)]; c >= 0; c = program_->column_before[c]) {
    const Twist& twist = twists_[c];
    const int dof = program_->column_dof[c];
    const Vector3d velocity = twist.linear + twist.angular.cross(p_WQ);
    J(0, dof) += factor * velocity[0];
    J(1, dof) += factor * velocity[1];
    J(2, dof) += factor * velocity[2];
  }
}

void State::addAngularJacobian(int frame, double factor, JacobianRows J) const {
  for (int c = program_->last_column[link(frame)]; c >= 0; c = program_->column_before[c]) {
    const Twist& twist = twists_[c];
    const int dof = program_->column_dof[c];
    J(0, dof) += factor * twist.angular[0];
    J(1, dof) += factor * twist.angular[1];
    J(2, dof) += factor * twist.angular[2];
  }
}

}  // namespace kinegraph
