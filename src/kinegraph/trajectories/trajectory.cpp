#include "kinegraph/trajectories/trajectory.h"

#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

constexpr double kLongestSampling = 1e8;  // samples

}  // namespace

MotionState Trajectory::eval(double t) const {
  MotionState state;
  eval(t, state);
  return state;
}

void Trajectory::eval(double t, MotionState& state) const {
  const int n = dimension();
  for (VectorXd* values : {&state.q, &state.velocity, &state.acceleration}) values->resize(n);
  evalTo(t, state.q.data(), state.velocity.data(), state.acceleration.data());
}

MotionStates Trajectory::eval(const VectorXd& times) const {
  const Eigen::Index count = times.size();
  const int n = dimension();
  MotionState state;
  MotionStates states{times, MatrixXd(count, n), MatrixXd(count, n), MatrixXd(count, n)};
  for (Eigen::Index k = 0; k < count; ++k) {
    eval(times[k], state);
    states.q.row(k) = state.q.transpose();
    states.velocity.row(k) = state.velocity.transpose();
    states.acceleration.row(k) = state.acceleration.transpose();
  }
  return states;
}

MotionStates Trajectory::sample(double rate) const {
  if (!(rate > 0.) || !(duration() * rate < kLongestSampling))
    throw ValueError(cat("Trajectory::sample: the rate is ", rate,
                         " Hz; expected a positive number that gives fewer than ", kLongestSampling, " samples in ",
                         duration(), " s"));
  const auto steps = Eigen::Index(std::ceil(duration() * rate - 1e-9));
  VectorXd times(steps + 1);
  for (Eigen::Index k = 0; k <= steps; ++k) times[k] = steps > 0 ? duration() * double(k) / double(steps) : 0.;
  if (steps > 0) times[steps] = duration();  // to the bit
  return eval(times);
}

}  // namespace kinegraph
