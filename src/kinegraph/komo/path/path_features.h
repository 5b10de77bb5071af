#pragma once

#include <memory>
#include <vector>

#include "kinegraph/features/feature.h"

namespace kinegraph::inline komo_internal {

/// Dofs of the joints of certain frames: y = q_i (rad, m). Unlike JointState it finds them by frame in each
/// configuration, because the index of a joint in q may differ between modes.
class JointsOfFrames final : public Feature {
 public:
  struct Part {
    int frame;
    int first;  ///< index among the dofs of its joint
    int count;
  };
  explicit JointsOfFrames(std::vector<Part> parts);

  int rows() const override { return rows_; }
  bool isLinear() const override { return true; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  std::vector<Part> parts_;
  int rows_ = 0;
};

}  // namespace kinegraph::inline komo_internal
