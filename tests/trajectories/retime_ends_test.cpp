#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/trajectories/curve_part.h"
#include "tests/support/expect_error.h"
#include "tests/trajectories/retime_paths.h"

using namespace kinegraph;
using namespace kinegraph::test;

TEST(RetimeEnds, VelocitiesAtTheEndsAreKept) {
  Rng rng(5);
  const MatrixXd path = randomPath(rng, 5, 2);
  for (const double jerk : {0., 200.}) {
    RetimeOptions options;
    options.start_velocity = .3 * (path.row(1) - path.row(0)).transpose().normalized();
    options.end_velocity = .2 * (path.row(4) - path.row(3)).transpose().normalized();
    const MotionLimits limits = limitsOf(2, 1., 4., jerk);
    const TimedPath timed = retime(path, limits, options);
    ASSERT_TRUE(timed.feasible()) << timed.message;
    EXPECT_LT((timed.eval(0.).velocity - options.start_velocity).norm(), 1e-9);
    EXPECT_LT((timed.eval(timed.duration()).velocity - options.end_velocity).norm(), 1e-9);
    EXPECT_LE(useOf(timed, limits).acceleration, 1. + kWithin);
  }
}

TEST(RetimeEnds, AccelerationsKeepTheirLimitsWhereItHardlyAccelerates) {
  Rng rng(3);
  for (int i = 0; i < 300; ++i) {
    const double velocity = rng.uniform(.1, 2.), acceleration = rng.uniform(.5, 9.);
    RetimeOptions options;
    options.start_velocity = VectorXd{{velocity * (1. - std::pow(10., rng.uniform(-16., -6.)))}};
    const double from = rng.uniform(-3., 3.);
    const TimedPath timed =
        retime(MatrixXd{{from}, {from + rng.uniform(3., 9.)}}, limitsOf(1, velocity, acceleration), options);
    ASSERT_TRUE(timed.feasible()) << timed.message;
    for (const ScalingPhase& phase : timed.scaling().phases())
      EXPECT_LE(timed.eval(phase.time).acceleration.norm(), acceleration * (1. + kWithin)) << phase.time;
  }
}

TEST(RetimeEnds, ReportsAnEndVelocityThatCannotBeBraked) {
  RetimeOptions options;
  options.start_velocity = VectorXd::Constant(1, 3.);
  const TimedPath timed = retime(line(1.), limitsOf(1, 10., 2.), options);  // sqrt(2 * 2 * 1) = 2 can be braked
  EXPECT_EQ(timed.status, RetimeStatus::start_too_fast);
  EXPECT_NE(timed.message.find("at most 2 would do"), std::string::npos) << timed.message;
  expectError<ValueError>([&] { timed.eval(0.); }, {"there is no motion", "cannot be braked"});
}

TEST(RetimeEnds, TheVelocityThatWouldDoDoesAndLittleMoreDoesNot) {
  const MatrixXd path{{0., 0.}, {.2, .1}, {.25, .4}, {.6, .5}};
  int told = 0;
  for (const double jerk : {0., 5., 60.}) {
    const MotionLimits limits = jerk > 0. ? limitsOf(2, 1., 2., jerk) : limitsOf(2, 1., 2.);
    for (const bool at_start : {true, false}) {
      for (const Corners corners : {Corners::blend, Corners::stop}) {
        RetimeOptions options;
        options.corners = corners;
        VectorXd& velocity = at_start ? options.start_velocity : options.end_velocity;
        const VectorXd along =
            (at_start ? path.row(1) - path.row(0) : path.row(3) - path.row(2)).transpose().normalized();
        velocity = 1.05 * along;
        const TimedPath timed = retime(path, limits, options);
        const std::size_t said = timed.message.find("a length of at most ");
        if (timed.feasible() || said == std::string::npos) continue;
        ++told;
        const double most = std::stod(timed.message.substr(said + 20));
        velocity = most * along;
        EXPECT_TRUE(retime(path, limits, options).feasible()) << jerk << " " << at_start << " " << most;
        velocity = 1.02 * most * along;
        EXPECT_FALSE(retime(path, limits, options).feasible()) << jerk << " " << at_start << " " << most;
      }
    }
  }
  EXPECT_GE(told, 6);
}

TEST(RetimeEnds, AMotionGoesOnWithTheAccelerationThatAnotherOneHas) {
  Rng rng(37);
  for (int i = 0; i < 20; ++i) {
    const MatrixXd path = randomPath(rng, 5, 3);
    const MotionLimits limits = limitsOf(3, 1.5, 4., 60.);
    RetimeOptions options;
    options.corners = Corners::spline;
    const TimedPath before = retime(path, limits, options);
    ASSERT_TRUE(before.feasible());
    for (const double share : {.07, .2, .5, .8}) {
      const double time = share * before.duration();
      const MotionState now = before.eval(time);
      const ScalingPhase& phase = before.scaling().phaseAt(time);
      const CurvePart rest = partOf(before.curve(), phase.at(time - phase.time).s, before.curve().length());
      options.start_velocity = now.velocity;
      options.start_acceleration = now.acceleration;
      const MotionLimits wider = limitsOf(3, 1.6, 5., 80.);
      const TimedPath after = retime(MatrixXd(), rest.curve, wider, options);
      ASSERT_TRUE(after.feasible()) << i << " " << share << " " << after.message;
      EXPECT_LE((after.eval(0.).velocity - now.velocity).norm(), 1e-9);
      EXPECT_LE((after.eval(0.).acceleration - now.acceleration).norm(), 1e-7 * (1. + now.acceleration.norm()));
      const Use use = useOf(after, wider);
      EXPECT_LE(use.acceleration, 1. + kWithin);
      EXPECT_LE(use.jerk, 1. + kWithin);
      EXPECT_LE(after.duration(), before.duration() - time);
      options.start_velocity = options.start_acceleration = {};
    }
  }
}

TEST(RetimeEnds, AStartAccelerationThatLeavesThePathIsRefused) {
  RetimeOptions options;
  options.start_velocity = VectorXd{{1., 0.}};
  options.start_acceleration = VectorXd{{1., .1}};
  MatrixXd path(2, 2);
  path << 0., 0., 1., 0.;
  const MotionLimits limits = limitsOf(2, 2., 4., 60.);
  expectError<ValueError>([&] { retime(path, limits, options); }, {"start_acceleration", "leaves the path"});
  options.start_acceleration = VectorXd{{1., 0.}};
  EXPECT_NEAR(retime(path, limits, options).eval(0.).acceleration[0], 1., 1e-9);
  expectError<ValueError>([&] { retime(path, limitsOf(2, 2., 4.), options); }, {"requires jerk limits"});
  options.start_velocity = {};
  expectError<ValueError>([&] { retime(path, limits, options); }, {"requires a start_velocity"});
}
