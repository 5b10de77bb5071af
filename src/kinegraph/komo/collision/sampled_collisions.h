#pragma once

#include <memory>
#include <vector>

#include "kinegraph/features/feature.h"
#include "kinegraph/komo/collision/sampled_pairs.h"

namespace kinegraph {

/// How near pairs of shapes come at instants s of the motion from one configuration to the next one,
///     q(s) = (1 - s) q_0 + s q_1,     J(s) = ((1 - s) J, s J)     at q(s)
/// either a row each, y_i = max(-distance_i, -most), of which those without a pair are -most; or the sum of what they
/// lack, y = sum_i max(0, most - distance_i). In m.
class SampledCollisions final : public Feature {
 public:
  enum class Form { stacked, sum };

  /// `most` in m. `same_dofs`: per dof of the first configuration that of the second, or -1 for those that keep their
  /// value. `begin` is any State of the first one.
  SampledCollisions(Form form, double most, std::vector<CollisionSample> samples, std::vector<int> same_dofs,
                    const State& begin);

  int rows() const override { return form_ == Form::sum ? 1 : samples_; }
  int order() const override { return 1; }
  std::optional<double> flatValue() const override;
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  void place(double s, const State& begin, const State& end, VectorXd& q) const;
  void spread(double s, int row, const SampledPairs::Gradient& gradient, JacobianRows& J) const;

  Form form_;
  double most_;
  int samples_;
  std::vector<int> same_dofs_;
  std::unique_ptr<SampledPairs> pairs_;  ///< null where all instants are empty
};

}  // namespace kinegraph
