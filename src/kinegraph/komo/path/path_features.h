#pragma once

#include <memory>
#include <vector>

#include "kinegraph/features/feature.h"

namespace kinegraph {

/// The dofs of the joints of given frames: y = q_i (rad, m). Unlike JointState it finds them by frame in each
/// configuration, because in different modes the same joint may have another place in q.
class JointsOfFrames final : public Feature {
 public:
  struct Part {
    int frame;
    int first;  ///< among the dofs of its joint
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

}  // namespace kinegraph
