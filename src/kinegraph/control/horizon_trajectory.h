#pragma once

#include <span>
#include <utility>
#include <vector>

#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph {

/// The motion that a call of Mpc computed, from the time of the call on: it passes through the points of the slices and
/// is nowhere faster than the fastest slice.
///
/// Between two points q_k is a cubic polynomial, and the velocity at a point is the difference of its neighbors over
/// their time. Where that cubic would exceed, in a dof, the largest mean velocity B of all intervals, the velocities at
/// both points are moved into the range in which it does not; if there is none, the velocity of the interval changes
/// linearly at both ends and is constant between them. It jumps where the mean velocity itself jumps from B. In the
/// first interval, B is at least its own mean velocity and the measured one.
class HorizonTrajectory final : public Trajectory {
 public:
  /// `times` (K) ascend from 0, K >= 1; `q` (n, K) has one point per column; `velocity` (n,) is that at time 0.
  HorizonTrajectory(std::vector<double> times, MatrixXd q, VectorXd velocity);

  /// Replaces the motion; the memory is requested again only if K changes.
  void assign(std::span<const double> times, const Eigen::Ref<const MatrixXd>& q,
              const Eigen::Ref<const VectorXd>& velocity);

  int dimension() const override { return int(q_.rows()); }
  double duration() const override { return times_.back(); }
  void evalTo(double t, double* q, double* velocity, double* acceleration) const override;

 private:
  double secant(int dof, int interval) const {
    return (q_(dof, interval + 1) - q_(dof, interval)) /
           (times_[std::size_t(interval) + 1] - times_[std::size_t(interval)]);
  }
  double largest(int dof, int interval) const { return interval == 0 ? largest_first_[dof] : largest_[dof]; }
  void findVelocities(const Eigen::Ref<const VectorXd>& velocity);
  void limitVelocities();

  std::vector<double> times_;
  MatrixXd q_, velocity_;             ///< (n, K)
  VectorXd largest_, largest_first_;  ///< velocities of an interval, and of the first one
};

}  // namespace kinegraph
