#pragma once

#include <vector>

#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph {

/// The motion that a call of Mpc computed: cubic polynomials between slices, from the time of the call on.
class HorizonTrajectory final : public Trajectory {
 public:
  /// The motion passes through the points at the times, which ascend from 0. There is at least one.
  HorizonTrajectory(std::vector<double> times, std::vector<VectorXd> q, std::vector<VectorXd> velocity);

  int dimension() const override { return int(q_.front().size()); }
  double duration() const override { return times_.back(); }
  void evalTo(double t, double* q, double* velocity, double* acceleration) const override;

 private:
  std::vector<double> times_;
  std::vector<VectorXd> q_, velocity_;
};

/// Returns the state at a time within [0, length] on the cubic from a to b with velocities va and vb.
MotionState cubicState(const VectorXd& a, const VectorXd& va, const VectorXd& b, const VectorXd& vb, double length,
                       double time);

}  // namespace kinegraph
