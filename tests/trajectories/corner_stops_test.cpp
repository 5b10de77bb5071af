#include "kinegraph/trajectories/corner_stops.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"

using namespace kinegraph;

namespace {

MatrixXd randomPoints(std::uint64_t seed, int points, int dofs, double step) {
  Rng rng(seed);
  MatrixXd path = MatrixXd::Zero(points, dofs);
  for (int i = 1; i < points; ++i)
    for (int j = 0; j < dofs; ++j) path(i, j) = path(i - 1, j) + rng.uniform(-step, step);
  return path;
}

MotionLimits withJerk(int dofs, double jerk) {
  return {VectorXd::Constant(dofs, 1.), VectorXd::Constant(dofs, 2.), VectorXd::Constant(dofs, jerk)};
}

}  // namespace

TEST(CornerStops, NoToleranceOfBlendsTakesLongerThanStops) {
  for (const std::uint64_t seed : {0, 1, 2}) {
    for (const double step : {.05, 1.}) {
      const MatrixXd path = randomPoints(seed, 8, 5, step);
      const MotionLimits limits = withJerk(5, 20.);
      const double stops = retime(path, limits, {.corners = Corners::stop}).duration();
      for (const double tolerance : {1e-9, 1e-6, 1e-4, 1e-3, 1e-2, .1}) {
        const TimedPath blended = retime(path, limits, {.tolerance = tolerance});
        ASSERT_TRUE(blended.feasible()) << blended.message;
        EXPECT_LE(blended.duration(), stops * (1. + 1e-9)) << seed << " " << step << " " << tolerance;
      }
    }
  }
}

TEST(CornerStops, OneTightCornerStopsAndAWideOneIsBlended) {
  MatrixXd path(4, 2);
  path << 0., 0., 1., 0., 2., .02, .5, .3;  // nearly straight, and nearly back
  const TimedPath timed = retime(path, withJerk(2, 20.), {.tolerance = 1e-3});
  ASSERT_TRUE(timed.feasible());
  VectorXd slow(2);
  for (int i = 0; i < 2; ++i) slow[i] = timed.eval(timed.times[i + 1]).velocity.norm();
  EXPECT_GT(slow[0], .3);
  EXPECT_LT(slow[1], 1e-6);
  EXPECT_LT(timed.duration(), retime(path, withJerk(2, 20.), {.corners = Corners::stop}).duration());
}

TEST(CornerStops, ANoisyRecordingIsTimedAlongASplineWithinItsJerkLimits) {
  Rng rng(0);
  MatrixXd path(701, 3);
  for (int i = 0; i < path.rows(); ++i)
    for (int j = 0; j < 3; ++j) path(i, j) = .5 * std::sin(.5 * .01 * i + j) + 1e-3 * rng.normal();
  const MotionLimits limits{VectorXd::Constant(3, 2.), VectorXd::Constant(3, 10.), VectorXd::Constant(3, 50.)};
  const TimedPath timed = retime(path, limits, {.corners = Corners::spline});
  ASSERT_TRUE(timed.feasible()) << timed.message;
  const int samples = 20000;
  const double step = timed.duration() / samples;
  VectorXd before = timed.eval(0.).acceleration;
  double jerk = 0.;
  for (int i = 1; i <= samples; ++i) {
    const VectorXd now = timed.eval(step * i).acceleration;
    jerk = std::max(jerk, (now - before).cwiseAbs().maxCoeff() / step);
    before = now;
  }
  EXPECT_LE(jerk, 50. * (1. + 1e-6));
  EXPECT_GT(jerk, 40.);
}
