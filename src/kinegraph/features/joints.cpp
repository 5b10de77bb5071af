#include "kinegraph/features/joints.h"

#include <cmath>

namespace kinegraph {

void JointState::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  for (int row = 0; row < rows(); ++row) {
    y[row] = states[0]->q()[dofs_[row]];
    if (J) (*J)(row, dofs_[row]) += 1.;
  }
}

JointLimits::JointLimits(const std::vector<int>& dofs, const Program& program) {
  for (int dof : dofs) {
    if (std::isfinite(program.lower[dof]) && std::isfinite(program.upper[dof])) limited_.push_back(dof);
  }
}

void JointLimits::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const State& state = *states[0];
  for (std::size_t i = 0; i < limited_.size(); ++i) {
    const int dof = limited_[i], row = 2 * int(i);
    y[row] = state.program().lower[dof] - state.q()[dof];
    y[row + 1] = state.q()[dof] - state.program().upper[dof];
    if (!J) continue;
    (*J)(row, dof) -= 1.;
    (*J)(row + 1, dof) += 1.;
  }
}

void QuaternionNorms::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const VectorXd& q = states[0]->q();
  for (int row = 0; row < rows(); ++row) {
    const auto [first, count] = groups_[row];
    y[row] = q.segment(first, count).squaredNorm() - 1.;
    if (J) J->row(row).segment(first, count) += 2. * q.segment(first, count).transpose();
  }
}

}  // namespace kinegraph
