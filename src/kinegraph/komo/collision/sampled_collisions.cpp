#include "kinegraph/komo/collision/sampled_collisions.h"

#include <algorithm>

namespace kinegraph {

AlongMotion::AlongMotion(Form form, double most, std::vector<PairInstant> instants, std::vector<int> same_dofs,
                         const State& begin)
    : form_(form), most_(most), instants_(int(instants.size())), same_dofs_(std::move(same_dofs)) {
  if (!std::ranges::all_of(instants, &PairInstant::isEmpty))
    pairs_ = std::make_unique<InstantPairs>(std::move(instants), most, begin);
}

std::optional<double> AlongMotion::flatValue() const {
  return form_ == Form::sum ? std::nullopt : std::optional(-most_);
}

void AlongMotion::place(double s, const State& begin, const State& end, VectorXd& q) const {
  for (std::size_t dof = 0; dof < same_dofs_.size(); ++dof) {
    const double from = begin.q()[Eigen::Index(dof)], to = same_dofs_[dof] < 0 ? from : end.q()[same_dofs_[dof]];
    q[Eigen::Index(dof)] = (1. - s) * from + s * to;
  }
}

/// Adds that of -distance at q(s) to the columns of both configurations.
void AlongMotion::spread(double s, int row, const InstantPairs::Gradient& gradient, JacobianRows& J) const {
  const Eigen::Index second = J.cols() / 2;
  for (std::size_t dof = 0; dof < same_dofs_.size(); ++dof) {
    const double value = gradient(0, Eigen::Index(dof));
    if (value == 0.) continue;
    const bool stays = same_dofs_[dof] < 0;
    J(row, Eigen::Index(dof)) -= stays ? value : (1. - s) * value;
    if (!stays) J(row, second + same_dofs_[dof]) -= s * value;
  }
}

void AlongMotion::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const bool is_sum = form_ == Form::sum;
  y.setConstant(is_sum ? 0. : -most_);
  if (!pairs_) return;
  double share = 0.;
  const auto place_at = [&](double s, VectorXd& q) { place(share = s, *states[0], *states[1], q); };
  const auto see = [&](int i, double distance, const InstantPairs::Gradient& gradient) {
    const int row = is_sum ? 0 : i;
    y[row] = is_sum ? y[row] + most_ - distance : -distance;
    if (J) spread(share, row, gradient, *J);
  };
  pairs_->visit(states[0]->sharedParameters(), J != nullptr, place_at, see);
}

}  // namespace kinegraph
