#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "kinegraph/features/feature.h"

namespace kinegraph {

/// A feature of one configuration at instants s of the motion to the next one,
///     q(s) = (1 - s) q_0 + s q_1,     J(s) = ((1 - s) J, s J)     at q(s)
/// either its values one below the other, or their sum: zero where there are no instants.
class AlongMotion final : public Feature {
 public:
  enum class Form { stacked, sum };

  /// Without instants.
  explicit AlongMotion(Form form) : form_(form) {}

  /// `same_dofs`: per dof of the first configuration that of the second, or -1 for those that keep their value. `begin`
  /// is any State of the first one.
  AlongMotion(Form form, std::unique_ptr<Feature> feature, std::vector<double> instants, std::vector<int> same_dofs,
              const State& begin);

  int rows() const override;
  int order() const override { return 1; }
  std::optional<double> flatValue() const override;
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  void place(double s, const State& begin, const State& end) const;
  void spread(double s, int first_row, JacobianRows& J) const;

  Form form_;
  std::unique_ptr<Feature> feature_;  ///< null without instants
  std::vector<double> instants_;
  std::vector<int> same_dofs_;
  /// What one evaluation at a time needs.
  struct Workspace {
    explicit Workspace(const State& scene) : state(scene) {}
    std::mutex mutex;
    State state;
    VectorXd q, y;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J;
  };
  std::unique_ptr<Workspace> work_;
};

}  // namespace kinegraph
