#pragma once

#include <memory>
#include <vector>

#include "kinegraph/features/feature.h"
#include "kinegraph/features/velocity.h"

namespace kinegraph {

/// The dofs of the joints of given frames: y = q_i (rad, m). Unlike JointState it finds them by frame in each configuration,
/// because in different modes the same joint may have another place in q.
class JointsOfFrames final : public Feature {
 public:
  struct Part {
    int frame;
    int first;  ///< among the dofs of its joint
    int count;
  };
  explicit JointsOfFrames(std::vector<Part> parts);

  int rows() const override { return rows_; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  std::vector<Part> parts_;
  int rows_ = 0;
};

/// Change of a frame's velocity less that of free fall, over one step (an impulse per mass, m/s and rad/s):
///     y = (v_t - v_{t-1} + (0, 0, g) tau,  w_t - w_{t-1})      6 rows; zero in free flight
/// With g = 0 it is zero for a body that slides on without friction.
class FreeFlight final : public Feature {
 public:
  FreeFlight(int frame, double gravity) : linear_(frame), angular_(frame), gravity_(gravity) {}

  int rows() const override { return 6; }
  int order() const override { return 2; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  LinearVelocity linear_;
  AngularVelocity angular_;
  double gravity_;  ///< m/s^2
};

}  // namespace kinegraph
