#include "kinegraph/features/joints.h"

#include <cmath>

namespace kinegraph::inline features_internal {

void JointState::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const int* dofs = dofs_.data();
  const double* q = states[0]->q().data();
  const Eigen::Index rows = y.size();
  for (Eigen::Index row = 0; row < rows; ++row) y[row] = q[dofs[row]];
  for (Eigen::Index row = 0; J && row < rows; ++row) (*J)(row, dofs[row]) += 1.;
}

bool JointState::addLaneRows(LaneRowList& list) const {
  for (int dof : dofs_) list.addJoint(dof);
  return true;
}

JointLimits::JointLimits(const std::vector<int>& dofs, const KinematicModel& model) {
  for (int dof : dofs) {
    if (std::isfinite(model.lower[dof]) && std::isfinite(model.upper[dof]))
      limited_.push_back({dof, model.lower[dof], model.upper[dof]});
  }
}

void JointLimits::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  int row = 0;
  for (const Limited& joint : limited_) {
    const double q = states[0]->q()[joint.dof];
    y[row] = joint.lower - q;
    y[row + 1] = q - joint.upper;
    if (J) {
      (*J)(row, joint.dof) -= 1.;
      (*J)(row + 1, joint.dof) += 1.;
    }
    row += 2;
  }
}

bool JointLimits::addLaneRows(LaneRowList& list) const {
  for (const Limited& joint : limited_) {
    list.addJoint(joint.dof, -1., joint.lower);
    list.addJoint(joint.dof, 1., -joint.upper);
  }
  return true;
}

void QuaternionNorms::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y,
                           JacobianRows* J) const {
  const VectorXd& q = states[0]->q();
  for (int row = 0; row < rows(); ++row) {
    const auto [first, count] = groups_[row];
    y[row] = q.segment(first, count).squaredNorm() - 1.;
    if (J) J->row(row).segment(first, count) += 2. * q.segment(first, count).transpose();
  }
}

}  // namespace kinegraph::inline features_internal
