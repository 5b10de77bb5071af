#include "kinegraph/kinematics/state.h"

#include "kinegraph/kinematics/state_kernel.h"

namespace kinegraph {

State::State(std::shared_ptr<const Program> program, std::shared_ptr<const Parameters> parameters)
    : program_(std::move(program)),
      parameters_(std::move(parameters)),
      q_(program_->home),
      link_pose_(program_->links.size()),
      twists_(program_->column_dof.size()),
      turns_(program_->turn_dof.size()) {
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
  static_assert(sizeof(RigidTransform) == 12 * sizeof(double) && sizeof(Twist) == 6 * sizeof(double) && sizeof(Turn) == 2 * sizeof(double));
  static const UpdateState kernel = stateKernel();
  const Program& program = *program_;
  kernel({program.links.data(), int(program.links.size()), program.steps.data(), parameters_->joint_base.data(), program.turn_dof.data(),
          program.turn_factor.data(), int(program.turn_dof.size()), q_.data(), reinterpret_cast<double*>(turns_.data()),
          link_pose_[0].R.data(), reinterpret_cast<double*>(twists_.data())});
}

void State::addPointJacobian(int frame, const Vector3d& p_WQ, double factor, JacobianRows J) const {
  double* rows = J.data();
  const Eigen::Index stride = J.outerStride();
  const double x = p_WQ[0], y = p_WQ[1], z = p_WQ[2];
  for (int c = program_->last_column[link(frame)]; c >= 0; c = program_->column_before[c]) {
    const double* w = twists_[c].angular.data();
    const double* v = twists_[c].linear.data();
    double* to = rows + program_->column_dof[c];
    to[0] += factor * (v[0] + (w[1] * z - w[2] * y));
    to[stride] += factor * (v[1] + (w[2] * x - w[0] * z));
    to[2 * stride] += factor * (v[2] + (w[0] * y - w[1] * x));
  }
}

void State::addAngularJacobian(int frame, double factor, JacobianRows J) const {
  double* rows = J.data();
  const Eigen::Index stride = J.outerStride();
  for (int c = program_->last_column[link(frame)]; c >= 0; c = program_->column_before[c]) {
    const double* w = twists_[c].angular.data();
    double* to = rows + program_->column_dof[c];
    to[0] += factor * w[0];
    to[stride] += factor * w[1];
    to[2 * stride] += factor * w[2];
  }
}

}  // namespace kinegraph
