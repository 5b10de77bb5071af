#include "kinegraph/control/horizon_trajectory.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace kinegraph {

MotionState cubicState(const VectorXd& a, const VectorXd& va, const VectorXd& b, const VectorXd& vb, double length,
                       double time) {
  const double s = time / length;
  const VectorXd da = length * va, db = length * vb, delta = b - a;  // derivatives with respect to s
  MotionState state;
  state.q = a + s * (da + s * ((3. * delta - 2. * da - db) + s * (da + db - 2. * delta)));
  state.velocity = (da + s * (2. * (3. * delta - 2. * da - db) + s * 3. * (da + db - 2. * delta))) / length;
  state.acceleration = (2. * (3. * delta - 2. * da - db) + s * 6. * (da + db - 2. * delta)) / (length * length);
  return state;
}

HorizonTrajectory::HorizonTrajectory(std::vector<double> times, std::vector<VectorXd> q, std::vector<VectorXd> velocity)
    : times_(std::move(times)), q_(std::move(q)), velocity_(std::move(velocity)) {
  assert(!times_.empty() && q_.size() == times_.size() && velocity_.size() == times_.size());
}

void HorizonTrajectory::evalTo(double t, double* q, double* velocity, double* acceleration) const {
  const int n = dimension();
  Eigen::Map<VectorXd> q_out(q, n), velocity_out(velocity, n), acceleration_out(acceleration, n);
  if (times_.size() == 1) {
    q_out = q_[0], velocity_out = velocity_[0], acceleration_out.setZero();
    return;
  }
  t = std::clamp(t, 0., duration());
  const auto after = std::lower_bound(times_.begin() + 1, times_.end(), t);
  const auto k = std::size_t(std::min(after, times_.end() - 1) - times_.begin());
  const MotionState state =
      cubicState(q_[k - 1], velocity_[k - 1], q_[k], velocity_[k], times_[k] - times_[k - 1], t - times_[k - 1]);
  q_out = state.q, velocity_out = state.velocity, acceleration_out = state.acceleration;
}

}  // namespace kinegraph
