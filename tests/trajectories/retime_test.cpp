#include "kinegraph/trajectories/retime.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "kinegraph/trajectories/curve_part.h"
#include "tests/support/expect_error.h"
#include "tests/trajectories/retime_paths.h"

using namespace kinegraph;
using namespace kinegraph::test;

namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

}  // namespace

TEST(Retime, ALineTakesWhatBangCruiseBangTakes) {
  // to 2 m/s in 0.5 s over 0.5 m, and down likewise; 9 m at 2 m/s
  EXPECT_NEAR(retime(line(10.), limitsOf(1, 2., 4.)).duration(), 5.5, 1e-12);
  // too short for that speed: two halves of 0.5 m at 4 m/s^2
  EXPECT_NEAR(retime(line(1.), limitsOf(1, 2., 4.)).duration(), 2. * std::sqrt(2. * .5 / 4.), 1e-12);
}

TEST(Retime, ALineWithJerkTakesWhatTheSevenPhasesTake) {
  // jerk 8 for 0.5 s to 4 m/s^2, 0 hold; 2 m/s after 1 s and 1 m; 8 m at 2 m/s; the same down
  EXPECT_NEAR(retime(line(10.), limitsOf(1, 2., 4., 8.)).duration(), 1. + 4. + 1., 1e-9);
  // four phases of equal time t with jerk 1: the distance is 2 t^3
  EXPECT_NEAR(retime(line(2.), limitsOf(1, 100., 100., 1.)).duration(), 4., 1e-9);
}

TEST(Retime, PathsThatGoNowhereTakeNoTime) {
  const MatrixXd one = MatrixXd::Constant(1, 3, .5), equal = MatrixXd::Constant(4, 3, .5);
  for (const MatrixXd& path : {one, equal}) {
    const TimedPath timed = retime(path, limitsOf(3, 1., 1., 1.));
    EXPECT_TRUE(timed.feasible());
    EXPECT_EQ(timed.duration(), 0.);
    EXPECT_EQ(timed.times, VectorXd::Zero(path.rows()));
    EXPECT_EQ(timed.eval(1.).q, VectorXd::Constant(3, .5));
    EXPECT_EQ(timed.eval(1.).velocity, VectorXd::Zero(3));
  }
}

TEST(Retime, EqualPointsAreAtTheSameTime) {
  MatrixXd path(4, 1);
  path << 0., 1., 1., 2.;
  const TimedPath timed = retime(path, limitsOf(1, 1., 1.));
  EXPECT_EQ(timed.times[1], timed.times[2]);
  EXPECT_NEAR(timed.duration(), retime(line(2.), limitsOf(1, 1., 1.)).duration(), 1e-12);
}

TEST(Retime, PointsThatDifferByRoundingAreOne) {
  MatrixXd path(5, 2), doubled(6, 2);
  path << 0., 0., .3, .2, .1, .6, .5, .7, .9, .1;
  doubled << path.topRows(3), path.row(2).array() + 2e-12, path.bottomRows(2);
  RetimeOptions options;
  options.corners = Corners::spline;
  const double duration = retime(path, limitsOf(2, 1., 2., 20.), options).duration();
  EXPECT_NEAR(retime(doubled, limitsOf(2, 1., 2., 20.), options).duration(), duration, 1e-6);
}

TEST(Retime, AMotionIsAtEachPointAtItsTime) {
  Rng rng(3);
  for (const Corners corners : {Corners::stop, Corners::spline}) {
    const MatrixXd path = randomPath(rng, 6, 3);
    RetimeOptions options;
    options.corners = corners;
    for (const MotionLimits& limits : {limitsOf(3, 1., 2.), limitsOf(3, 1., 2., 20.)}) {
      const TimedPath timed = retime(path, limits, options);
      ASSERT_TRUE(timed.feasible()) << timed.message;
      for (int i = 0; i < path.rows(); ++i)
        EXPECT_LT((timed.eval(timed.times[i]).q - path.row(i).transpose()).cwiseAbs().maxCoeff(), 1e-8);
    }
  }
}

TEST(Retime, StopsAtCornersAreStops) {
  RetimeOptions options;
  options.corners = Corners::stop;
  for (const MotionLimits& limits : {limitsOf(2, 1., 2.), limitsOf(2, 1., 2., 30.)}) {
    const TimedPath timed = retime(corner(), limits, options);
    EXPECT_LT(timed.eval(timed.times[1]).velocity.norm(), 1e-6);
    EXPECT_NEAR(timed.duration(), 2. * retime(line(1.), limitsOf(1, 1., 2., limits.limitsJerk() ? 30. : 0.)).duration(),
                1e-9);
  }
}

TEST(Retime, BlendsMissTheirCornerByTheToleranceAndAreFasterThanStops) {
  for (const MotionLimits& limits : {limitsOf(2, 1., 2.), limitsOf(2, 1., 2., 30.)}) {
    RetimeOptions options;
    options.tolerance = .02;
    const TimedPath timed = retime(corner(), limits, options);
    EXPECT_NEAR((timed.eval(timed.times[1]).q - Eigen::Vector2d(1., 0.)).cwiseAbs().maxCoeff(), .02, 1e-6);
    EXPECT_GT(timed.eval(timed.times[1]).velocity.norm(), .1);
    options.corners = Corners::stop;
    EXPECT_LT(timed.duration(), retime(corner(), limits, options).duration());
  }
}

TEST(Retime, AtAReversalABlendTakesNoLongerThanAStop) {
  const MotionLimits limits{VectorXd::Ones(2), VectorXd::Ones(2), VectorXd::Constant(2, 10.)};
  for (const double degrees : {0., .01, .1, .3, 1., 5.}) {
    const double a = degrees / 180. * std::numbers::pi;
    const MatrixXd path{{0., 0.}, {1., 0.}, {1. - std::cos(a), std::sin(a)}};
    const double stops = retime(path, limits, {.corners = Corners::stop}).duration();
    for (const double tolerance : {1e-3, .01, .1, .3})
      EXPECT_LE(retime(path, limits, {.tolerance = tolerance}).duration(), 1.03 * stops) << degrees << " " << tolerance;
  }
}

TEST(Retime, BlendsThatAreNotFreeBecomeSmallerAndThenStops) {
  RetimeOptions options;
  options.tolerance = .1;
  int asked = 0;
  options.is_free = [&](const MatrixXd& points, double deviation) {
    ++asked;
    EXPECT_LT(deviation, .01);
    return points.col(1).maxCoeff() < .1;  // extent along the second line
  };
  const TimedPath small = retime(corner(), limitsOf(2, 1., 2.), options);
  EXPECT_GT(asked, 1);
  EXPECT_GT(small.eval(small.times[1]).velocity.norm(), .05);
  options.is_free = [](const MatrixXd&, double) { return false; };
  const TimedPath stopping = retime(corner(), limitsOf(2, 1., 2.), options);
  EXPECT_LT(stopping.eval(stopping.times[1]).velocity.norm(), 1e-6);
}

TEST(Retime, LimitsHoldAllAlongRandomPaths) {
  Rng rng(7);
  for (int i = 0; i < 60; ++i) {
    const int dofs = 1 + i % 7, points = 2 + i % 9;
    const MatrixXd path = randomPath(rng, points, dofs);
    MotionLimits limits = limitsOf(dofs, 1., 1., i % 2 ? 10. : 0.);
    for (int j = 0; j < dofs; ++j) {
      limits.velocity[j] = rng.uniform(.2, 3.), limits.acceleration[j] = rng.uniform(.5, 20.);
      if (limits.limitsJerk()) limits.jerk[j] = rng.uniform(5., 500.);
    }
    RetimeOptions options;
    options.corners = Corners(i % 3);
    options.tolerance = rng.uniform(0., .3);
    options.intervals = 40;
    const TimedPath timed = retime(path, limits, options);
    ASSERT_TRUE(timed.feasible()) << i << ": " << timed.message;
    const Use use = useOf(timed, limits, 2000);
    EXPECT_LE(use.velocity, 1. + kWithin) << i;
    EXPECT_LE(use.acceleration, 1. + kWithin) << i;
    EXPECT_LE(use.jerk, 1. + 1e-6) << i;  // differences have rounding errors
  }
}

TEST(Retime, WithJerkLimitsAHundredIntervalsAreNearlyAsFastAsManyMore) {
  Rng rng(19);
  RetimeOptions options, fine;
  options.corners = fine.corners = Corners::spline;
  fine.intervals = 1600;
  for (int i = 0; i < 12; ++i) {
    const MatrixXd path = randomPath(rng, 4 + i % 5, 5);
    const MotionLimits limits = limitsOf(5, 2., 6., i % 2 ? 60. : 2000.);
    const TimedPath timed = retime(path, limits, options);
    ASSERT_TRUE(timed.feasible()) << timed.message;
    EXPECT_LT(timed.duration(), 1.02 * retime(path, limits, fine).duration()) << i;
  }
}

TEST(Retime, ATokenCancelsIt) {
  Rng rng(23);
  const MatrixXd path = randomPath(rng, 6, 3);
  for (const double jerk : {0., 30.}) {
    RetimeOptions options;
    options.corners = Corners::spline;
    options.intervals = 4000;
    int asked = 0;
    options.cancellation = [&] { ++asked; };
    retime(path, limitsOf(3, 1., 2., jerk), options);
    EXPECT_GT(asked, jerk > 0. ? 2000 : 200);
    for (const int last : {1, asked / 2, asked - 1}) {
      int count = 0;
      options.cancellation = [&] {
        if (++count == last) throw ValueError("enough");
      };
      expectError<ValueError>([&] { retime(path, limitsOf(3, 1., 2., jerk), options); }, {"enough"});
    }
  }
}

TEST(Retime, VelocityAndAccelerationAreTheDerivativesOfTheMotion) {
  Rng rng(11);
  RetimeOptions options;
  options.corners = Corners::spline;
  const TimedPath timed = retime(randomPath(rng, 6, 3), limitsOf(3, 2., 5., 50.), options);
  constexpr double kStep = 1e-5;
  for (int i = 1; i < 50; ++i) {
    const double t = timed.duration() * i / 50.;
    const MotionState before = timed.eval(t - kStep), at = timed.eval(t), after = timed.eval(t + kStep);
    EXPECT_LT(((after.q - before.q) / (2. * kStep) - at.velocity).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LT(((after.velocity - before.velocity) / (2. * kStep) - at.acceleration).cwiseAbs().maxCoeff(), 1e-3);
  }
}

TEST(Retime, ConstraintsOfTheCallerHoldAtAllGridpointsAndNameTheOneThatForbidsRest) {
  ConstraintSource rows;  // s'' + s'^2 + c <= 3, with c = 1 + s
  rows.low = VectorXd::Constant(1, -kNoLimit), rows.high = VectorXd::Constant(1, 3.);
  rows.names = {"shoulder"};
  rows.at = [](double s, int) {
    return ScalingConstraints{VectorXd::Constant(1, 1.), VectorXd::Constant(1, 1.), VectorXd::Constant(1, 1. + s)};
  };
  RetimeOptions options;
  options.constraints = rows;
  const TimedPath timed = retime(line(1.), limitsOf(1, 10., 10.), options);
  ASSERT_TRUE(timed.feasible()) << timed.message;
  for (int i = 0; i <= 1000; ++i) {
    const MotionState state = timed.eval(timed.duration() * i / 1000.);
    EXPECT_LE(state.acceleration[0] + state.velocity[0] * state.velocity[0] + 1. + state.q[0], 3. + 1e-3);
  }
  options.constraints.high[0] = 1.5;
  const TimedPath held = retime(line(1.), limitsOf(1, 10., 10.), options);
  EXPECT_EQ(held.status, RetimeStatus::cannot_move);
  EXPECT_NE(held.message.find("'shoulder' cannot rest"), std::string::npos) << held.message;
}

TEST(Retime, InfiniteLimitsLimitNothing) {
  MotionLimits limits = limitsOf(2, 1., 2.);
  limits.velocity[1] = limits.acceleration[1] = kNoLimit;
  MatrixXd path(2, 2);
  path << 0., 0., 1., 1.;
  EXPECT_NEAR(retime(path, limits).duration(), 1.5, 1e-12);
  limits.acceleration[0] = kNoLimit;
  EXPECT_NEAR(retime(path, limits).duration(), 1., 1e-6);
  path(1, 0) = 0.;
  expectError<ValueError>([&] { retime(path, limits); }, {"the speed is unlimited at 0 %", "dofs 1"});
}

TEST(Retime, WithLargeJerkLimitsItIsNearlyAsFastAsWithoutThem) {
  Rng rng(29);
  const MatrixXd path = randomPath(rng, 5, 2);
  RetimeOptions options;
  options.corners = Corners::spline;
  const double least = retime(path, limitsOf(2, 1., 2.), options).duration();
  for (const double jerk : {1e6, kNoLimit}) {
    const TimedPath timed = retime(path, limitsOf(2, 1., 2., jerk), options);
    ASSERT_TRUE(timed.feasible()) << timed.message;
    EXPECT_LT(timed.duration(), 1.03 * least);
  }
}

TEST(Retime, TooFewIntervalsAreDoubled) {
  Rng rng(31);
  for (int i = 0; i < 250; ++i) {
    const MatrixXd path = randomPath(rng, 12, 2);
    MotionLimits limits = limitsOf(2, 1., 1., 1.);
    for (VectorXd* limit : {&limits.velocity, &limits.acceleration, &limits.jerk})
      for (double& value : *limit) value = std::pow(10., rng.uniform(-1., 1.));
    limits.jerk *= 30.;
    RetimeOptions options;
    options.tolerance = rng.uniform(.001, .3);
    options.intervals = 10;
    const TimedPath timed = retime(path, limits, options);
    EXPECT_TRUE(timed.feasible()) << i << ": " << timed.message;
  }
}

TEST(Retime, ManyIntervalsAreAsFastAndKeepTheLimits) {
  Rng rng(29);
  const MatrixXd path = randomPath(rng, 4, 2);
  for (const Corners corners : {Corners::spline, Corners::blend}) {
    for (const double jerk : {0., 60.}) {
      const MotionLimits limits = limitsOf(2, 2., 5., jerk);
      RetimeOptions options;
      options.corners = corners;
      options.intervals = 1000;
      const TimedPath some = retime(path, limits, options);
      options.intervals = corners == Corners::spline ? 300000 : 30000;  // blends are short
      const TimedPath many = retime(path, limits, options);
      ASSERT_TRUE(some.feasible() && many.feasible()) << many.message;
      EXPECT_LE(many.duration(), some.duration() * (1. + 1e-6)) << jerk;
      EXPECT_GE(many.duration(), .99 * some.duration()) << jerk;
      const Use use = useOf(many, limits);
      EXPECT_LE(use.velocity, 1. + kWithin);
      EXPECT_LE(use.acceleration, 1. + kWithin);
      EXPECT_LE(use.jerk, 1. + kWithin);  // 0 without a limit
    }
  }
}

TEST(Retime, ATokenCancelsManyIntervals) {
  Rng rng(31);
  const MatrixXd path = randomPath(rng, 4, 2);
  for (const double jerk : {0., 60.}) {
    RetimeOptions options;
    options.corners = Corners::spline;
    options.intervals = 1000000;
    int count = 0;
    options.cancellation = [&] {
      if (++count == 1000) throw ValueError("enough");
    };
    expectError<ValueError>([&] { retime(path, limitsOf(2, 1., 2., jerk), options); }, {"enough"});
  }
}

TEST(Retime, MistakesAreNamed) {
  const MotionLimits limits = limitsOf(1, 1., 1.);
  expectError<ValueError>([&] { retime(MatrixXd(0, 1), limits); }, {"shape (0, 1)", "K >= 1"});
  expectError<ValueError>([&] { retime(line(std::nan("")), limits); }, {"path[1, 0]", "nan"});
  expectError<ValueError>([&] { retime(line(1.), limitsOf(2, 1., 1.)); }, {"velocity has 2 entries", "1 dofs"});
  expectError<ValueError>([&] { retime(line(1.), limitsOf(1, 1., 0.)); }, {"acceleration[0] is 0"});
  RetimeOptions options;
  options.start_velocity = VectorXd::Constant(1, -1.);
  expectError<ValueError>([&] { retime(line(1.), limits, options); }, {"start_velocity", "along the path"});
  expectError<ValueError>([&] { cornersOfName("splin"); }, {"'splin'", "similar names: spline"});
}

TEST(Retime, CurvesOfAHigherDegreeThanItBoundsAreRefused) {
  PathCurve::Parts parts{.dofs = 1, .degree = 5, .length = 1., .begin = {0.}, .marks = {0., 1.}};
  parts.coefficients = {0., 1., 0., 0., 0., .1}, parts.is_line = {false}, parts.stops = {false};
  expectError<ValueError>([&] { retime(MatrixXd(), PathCurve::fromParts(parts), limitsOf(1, 1., 1.)); },
                          {"degree 5", "at most 4"});
}
