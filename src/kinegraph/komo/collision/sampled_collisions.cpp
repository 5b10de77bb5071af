#include "kinegraph/komo/collision/sampled_collisions.h"

#include <algorithm>

namespace kinegraph::inline komo_internal {

SampledCollisions::SampledCollisions(Form form, double max_distance, std::vector<CollisionSample> samples,
                                     std::vector<int> same_dofs, const State& begin)
    : form_(form), max_distance_(max_distance), samples_(int(samples.size())), same_dofs_(std::move(same_dofs)) {
  if (!std::ranges::all_of(samples, &CollisionSample::isEmpty))
    pairs_ = std::make_unique<SampledPairs>(std::move(samples), max_distance, begin);
}

std::optional<double> SampledCollisions::flatValue() const {
  return form_ == Form::sum ? std::nullopt : std::optional(-max_distance_);
}

void SampledCollisions::place(double s, const State& begin, const State& end, VectorXd& q) const {
  for (std::size_t dof = 0; dof < same_dofs_.size(); ++dof) {
    const double from = begin.q()[Eigen::Index(dof)], to = same_dofs_[dof] < 0 ? from : end.q()[same_dofs_[dof]];
    q[Eigen::Index(dof)] = (1. - s) * from + s * to;
  }
}

/// Adds the gradient of -distance at q(s) to the columns of both configurations.
void SampledCollisions::addGradient(double s, int row, const SampledPairs::Gradient& gradient, JacobianRows& J) const {
  const Eigen::Index second = J.cols() / 2;
  for (std::size_t dof = 0; dof < same_dofs_.size(); ++dof) {
    const double value = gradient(0, Eigen::Index(dof));
    if (value == 0.) continue;
    const bool is_constant = same_dofs_[dof] < 0;
    J(row, Eigen::Index(dof)) -= is_constant ? value : (1. - s) * value;
    if (!is_constant) J(row, second + same_dofs_[dof]) -= s * value;
  }
}

void SampledCollisions::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y,
                             JacobianRows* J) const {
  const bool is_sum = form_ == Form::sum;
  y.setConstant(is_sum ? 0. : -max_distance_);
  if (!pairs_) return;
  double time = 0.;
  const auto place_at = [&](double s, VectorXd& q) { place(time = s, *states[0], *states[1], q); };
  const auto report = [&](int i, double distance, const SampledPairs::Gradient& gradient) {
    const int row = is_sum ? 0 : i;
    y[row] = is_sum ? y[row] + max_distance_ - distance : -distance;
    if (J) addGradient(time, row, gradient, *J);
  };
  pairs_->visit(states[0]->sharedParameters(), J != nullptr, place_at, report);
}

}  // namespace kinegraph::inline komo_internal
