#pragma once

#include <algorithm>

#include "kinegraph/common/random.h"
#include "kinegraph/trajectories/retime.h"

namespace kinegraph::test {

constexpr double kWithin = 1e-9;  ///< largest relative violation of a limit

inline MotionLimits limitsOf(int dofs, double velocity, double acceleration, double jerk = 0.) {
  MotionLimits limits{VectorXd::Constant(dofs, velocity), VectorXd::Constant(dofs, acceleration), {}};
  if (jerk > 0.) limits.jerk = VectorXd::Constant(dofs, jerk);
  return limits;
}

inline MatrixXd line(double length) {
  MatrixXd path(2, 1);
  path << 0., length;
  return path;
}

inline MatrixXd corner() {
  MatrixXd path(3, 2);
  path << 0., 0., 1., 0., 1., 1.;
  return path;
}

/// The largest ratios of a motion to its limits at `samples` times. Differences of accelerations give the mean jerk of
/// a step, which is at most the largest jerk.
struct Use {
  double velocity = 0., acceleration = 0., jerk = 0.;
};

inline Use useOf(const TimedPath& timed, const MotionLimits& limits, int samples = 4000) {
  Use use;
  const double step = timed.duration() / samples;
  VectorXd before;
  for (int i = 0; i <= samples; ++i) {
    const MotionState state = timed.eval(step * i);
    use.velocity = std::max(use.velocity, (state.velocity.array().abs() / limits.velocity.array()).maxCoeff());
    use.acceleration =
        std::max(use.acceleration, (state.acceleration.array().abs() / limits.acceleration.array()).maxCoeff());
    if (i && limits.limitsJerk())
      use.jerk =
          std::max(use.jerk, ((state.acceleration - before).array().abs() / (step * limits.jerk.array())).maxCoeff());
    before = state.acceleration;
  }
  return use;
}

inline MatrixXd randomPath(Rng& rng, int points, int dofs) {
  MatrixXd path(points, dofs);
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < dofs; ++j) path(i, j) = rng.uniform(-2., 2.);
  return path;
}

}  // namespace kinegraph::test
