#pragma once

#include <memory>
#include <vector>

#include "kinegraph/features/feature.h"
#include "kinegraph/komo/collision/sampled_pairs.h"

namespace kinegraph::inline komo_internal {

/// Distances of pairs of shapes at fractions s of the motion from one configuration to the next one,
///
///     q(s) = (1 - s) q_0 + s q_1,     J(s) = ((1 - s) J, s J)     at q(s)
///
/// either stacked, y_i = max(-distance_i, -max_distance), with -max_distance for empty samples; or as the sum of the
/// violations, y = sum_i max(0, max_distance - distance_i). In m.
class SampledCollisions final : public Feature {
 public:
  enum class Form { stacked, sum };

  /// `max_distance` in m. `same_dofs`: per dof of the first configuration that of the second, or -1 for dofs that keep
  /// their value. `begin` is any State of the first one.
  SampledCollisions(Form form, double max_distance, std::vector<CollisionSample> samples, std::vector<int> same_dofs,
                    const State& begin);

  int rows() const override { return form_ == Form::sum ? 1 : samples_; }
  int order() const override { return 1; }
  std::optional<double> flatValue() const override;
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  void place(double s, const State& begin, const State& end, VectorXd& q) const;
  void addGradient(double s, int row, const SampledPairs::Gradient& gradient, JacobianRows& J) const;

  Form form_;
  double max_distance_;
  int samples_;
  std::vector<int> same_dofs_;
  std::unique_ptr<SampledPairs> pairs_;  ///< null if all samples are empty
};

}  // namespace kinegraph::inline komo_internal
