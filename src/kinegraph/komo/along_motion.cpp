#include "kinegraph/komo/along_motion.h"

namespace kinegraph {

AlongMotion::AlongMotion(Form form, std::unique_ptr<Feature> feature, std::vector<double> instants,
                         std::vector<int> same_dofs, const State& begin)
    : form_(form),
      feature_(std::move(feature)),
      instants_(std::move(instants)),
      same_dofs_(std::move(same_dofs)),
      work_(std::make_unique<Workspace>(begin)) {
  work_->q.resize(begin.dofs());
  work_->y.resize(feature_->rows());
  work_->J.resize(feature_->rows(), begin.dofs());
}

int AlongMotion::rows() const {
  if (!feature_) return form_ == Form::sum ? 1 : 0;
  return feature_->rows() * (form_ == Form::sum ? 1 : int(instants_.size()));
}

std::optional<double> AlongMotion::flatValue() const {
  return form_ == Form::sum || !feature_ ? std::nullopt : feature_->flatValue();
}

void AlongMotion::place(double s, const State& begin, const State& end) const {
  Workspace& work = *work_;
  for (std::size_t dof = 0; dof < same_dofs_.size(); ++dof) {
    const double from = begin.q()[Eigen::Index(dof)], to = same_dofs_[dof] < 0 ? from : end.q()[same_dofs_[dof]];
    work.q[Eigen::Index(dof)] = (1. - s) * from + s * to;
  }
  if (work.state.sharedParameters() != begin.sharedParameters()) work.state.replaceParameters(begin.sharedParameters());
  work.state.setJoints(work.q.data());
}

/// Adds the Jacobian at q(s) to the columns of both configurations.
void AlongMotion::spread(double s, int first_row, JacobianRows& J) const {
  const auto& at = work_->J;
  const Eigen::Index second = J.cols() / 2;
  for (Eigen::Index row = 0; row < at.rows(); ++row) {
    for (std::size_t dof = 0; dof < same_dofs_.size(); ++dof) {
      const double value = at(row, Eigen::Index(dof));
      if (value == 0.) continue;
      const bool stays = same_dofs_[dof] < 0;
      J(first_row + row, Eigen::Index(dof)) += stays ? value : (1. - s) * value;
      if (!stays) J(first_row + row, second + same_dofs_[dof]) += s * value;
    }
  }
}

void AlongMotion::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                       JacobianRows* J) const {
  if (form_ == Form::sum) y.setZero();
  if (!feature_) return;
  const std::lock_guard lock(work_->mutex);
  const State* const at[] = {&work_->state};
  int row = 0;
  for (const double s : instants_) {
    place(s, *states[0], *states[1]);
    if (J) {
      work_->J.setZero();
      JacobianRows view = work_->J;
      feature_->eval(at, tau, work_->y, &view);
      spread(s, row, *J);
    } else {
      feature_->eval(at, tau, work_->y, nullptr);
    }
    if (form_ == Form::sum) {
      y += work_->y;
    } else {
      y.segment(row, feature_->rows()) = work_->y;
      row += feature_->rows();
    }
  }
}

}  // namespace kinegraph
