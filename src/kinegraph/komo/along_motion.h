#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "kinegraph/features/feature.h"
#include "kinegraph/komo/pair_instant.h"

namespace kinegraph {

/// How near pairs of shapes come at instants s of the motion from one configuration to the next one,
///     q(s) = (1 - s) q_0 + s q_1,     J(s) = ((1 - s) J, s J)     at q(s)
/// either a row each, y_i = max(-distance_i, -most), of which those without a pair are -most; or the sum of what they
/// lack, y = sum_i max(0, most - distance_i). In m.
class AlongMotion final : public Feature {
 public:
  enum class Form { stacked, sum };

  /// `most` in m. `same_dofs`: per dof of the first configuration that of the second, or -1 for those that keep their
  /// value. `begin` is any State of the first one.
  AlongMotion(Form form, double most, std::vector<PairInstant> instants, std::vector<int> same_dofs,
              const State& begin);

  int rows() const override { return form_ == Form::sum ? 1 : int(instants_.size()); }
  int order() const override { return 1; }
  std::optional<double> flatValue() const override;
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  void place(double s, const State& begin, const State& end) const;
  void spread(double s, int row, JacobianRows& J) const;

  Form form_;
  double most_;
  std::vector<PairInstant> instants_;
  std::vector<int> in_order_;  ///< those that are not empty, by their shares
  std::vector<int> same_dofs_;
  /// What one evaluation at a time needs.
  struct Workspace {
    explicit Workspace(const State& scene) : state(scene), q(scene.dofs()), gradient(1, scene.dofs()) {}
    std::mutex mutex;
    State state;
    VectorXd q;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> gradient;  ///< one row
  };
  std::unique_ptr<Workspace> work_;  ///< null where all are empty
};

}  // namespace kinegraph
