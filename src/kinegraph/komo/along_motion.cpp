#include "kinegraph/komo/along_motion.h"

#include <algorithm>

#include "kinegraph/features/distance.h"

namespace kinegraph {

namespace {

/// Do the spheres around two bodies show that they are that far apart?
bool areFar(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b, const RigidTransform& X_WB,
            double most) {
  const double reach = a.boundRadius() + b.boundRadius() + most;
  return reach >= 0. && (X_WA * a.boundCenter() - X_WB * b.boundCenter()).squaredNorm() > reach * reach;
}

}  // namespace

AlongMotion::AlongMotion(Form form, double most, std::vector<PairInstant> instants, std::vector<int> same_dofs,
                         const State& begin)
    : form_(form), most_(most), instants_(std::move(instants)), same_dofs_(std::move(same_dofs)) {
  for (std::size_t i = 0; i < instants_.size(); ++i)
    if (!instants_[i].isEmpty()) in_order_.push_back(int(i));
  std::ranges::stable_sort(in_order_, {}, [&](int i) { return instants_[std::size_t(i)].share; });
  if (!in_order_.empty()) work_ = std::make_unique<Workspace>(begin);
}

std::optional<double> AlongMotion::flatValue() const {
  return form_ == Form::sum ? std::nullopt : std::optional(-most_);
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

/// Adds the gradient at q(s) to the columns of both configurations.
void AlongMotion::spread(double s, int row, JacobianRows& J) const {
  const Eigen::Index second = J.cols() / 2;
  for (std::size_t dof = 0; dof < same_dofs_.size(); ++dof) {
    const double value = work_->gradient(0, Eigen::Index(dof));
    if (value == 0.) continue;
    const bool stays = same_dofs_[dof] < 0;
    J(row, Eigen::Index(dof)) += stays ? value : (1. - s) * value;
    if (!stays) J(row, second + same_dofs_[dof]) += s * value;
  }
}

void AlongMotion::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  y.setConstant(form_ == Form::sum ? 0. : -most_);
  if (!work_) return;
  const std::lock_guard lock(work_->mutex);
  const State& state = work_->state;
  double placed = -1.;
  for (const int i : in_order_) {
    const auto& [share, a, b] = instants_[std::size_t(i)];
    if (share != placed) place(placed = share, *states[0], *states[1]);
    const CollisionBody &body_a = *state.program().body[std::size_t(a)],
                        &body_b = *state.program().body[std::size_t(b)];
    const RigidTransform X_WA = state.pose(a), X_WB = state.pose(b);
    if (areFar(body_a, X_WA, body_b, X_WB, most_)) continue;
    const Proximity near = proximity(body_a, X_WA, body_b, X_WB);
    if (near.distance >= most_) continue;
    const int row = form_ == Form::sum ? 0 : i;
    y[row] = form_ == Form::sum ? y[row] + most_ - near.distance : -near.distance;
    if (!J) continue;
    work_->gradient.setZero();
    JacobianRows gradient = work_->gradient;
    addDistanceGradient(state, a, b, near, -1., gradient);
    spread(share, row, *J);
  }
}

}  // namespace kinegraph
