#include "kinegraph/trajectories/trajectory.h"

#include <gtest/gtest.h>

#include <vector>

#include "kinegraph/common/random.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

VectorXd numbers(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), Eigen::Index(values.size()));
}

void expectNear(const MatrixXd& given, const std::vector<double>& expected, double tolerance = 1e-12) {
  ASSERT_EQ(given.size(), Eigen::Index(expected.size()));
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(given(Eigen::Index(i)), expected[i], tolerance) << i;
}

BSpline line(int degree = 2) { return BSpline(degree, numbers({0, 1}), numbers({0, 1})); }

/// A spline through random points, with random gaps between times.
BSpline randomSpline(Rng& rng, int degree, int count, int dimension, bool in_motion = false) {
  MatrixXd points(count, dimension);
  for (double& x : points.reshaped()) x = rng.normal();
  VectorXd times(count);
  double time = rng.normal();
  for (double& t : times) t = time += .1 + rng.uniform();
  const VectorXd velocity = in_motion ? VectorXd::Constant(dimension, rng.normal()) : VectorXd();
  return BSpline(degree, points, times, velocity, velocity);
}

}  // namespace

// Recorded from robotic 0.4.2.
TEST(BSpline, HasTheKnotsAndValuesOfTheReference) {
  const BSpline square(2, numbers({0, 1, 2}), numbers({0, 1, 3}));
  expectNear(square.getKnots(), {0, 0, 0, .5, 2, 3, 3, 3});
  expectNear(square.getCtrlPoints(), {0, 0, 1, 2, 2});
  expectNear(square.eval(numbers({-.5, 0, .25, .5, 1, 2, 2.999, 3})), {0, 0, .0625, .25, .73333, 1.6, 2, 2}, 1e-5);
  expectNear(square.eval(numbers({0, .5, 1, 3}), 1), {0, 1, .93333, 0}, 1e-5);
  expectNear(square.eval3(.5), {.25, 1, -.1333}, 1e-4);

  const BSpline cubic(3, numbers({0, 1, 2}), numbers({0, 1, 3}));
  expectNear(cubic.getKnots(), {0, 0, 0, 0, 1, 3, 3, 3, 3});
  expectNear(cubic.eval(numbers({.5, 1, 2})), {.20833, .66667, 1.58333}, 1e-5);

  const BSpline started(2, numbers({0, 1}), numbers({0, 1}), numbers({1}));
  expectNear(started.getCtrlPoints(), {0, .25, 1, 1});
  expectNear(started.eval(numbers({0, .5, 1}), 1), {1, 1.5, 0});
}

TEST(BSpline, GoesOnAsTheReferenceDoes) {
  BSpline behind = line(), inside = line(), cut = line();
  behind.append(numbers({2}), numbers({1}));
  expectNear(behind.getKnots(), {0, 0, 0, .5, 1, 1.5, 2, 2, 2});
  expectNear(behind.getCtrlPoints(), {0, 0, 1, 1, 2, 2});
  inside.append(numbers({2}), numbers({1}), true);
  expectNear(inside.getKnots(), {0, 0, 0, .5, 1.25, 2, 2, 2});
  expectNear(inside.getCtrlPoints(), {0, 0, 1, 2, 2});
  cut.overwriteSmooth(numbers({2}), numbers({1}), .5);
  expectNear(cut.getKnots(), {.5, .5, .5, 1, 1.5, 1.5, 1.5});
  expectNear(cut.getCtrlPoints(), {.5, 1, 2, 2});
}

TEST(BSpline, DerivativesAreThoseOfDifferences) {
  Rng rng(3);
  for (int degree = 1; degree <= 5; ++degree) {
    const BSpline spline = randomSpline(rng, degree, 6, 3);
    for (int k = 1; k < degree; ++k) {
      for (int i = 1; i < 20; ++i) {
        const double t = spline.start() + (spline.end() - spline.start()) * i / 20.003, h = 1e-6;
        const VectorXd slope = (spline.eval(t + h, k - 1) - spline.eval(t - h, k - 1)) / (2 * h);
        EXPECT_LT((spline.eval(t, k) - slope).norm(), 1e-5 * (1 + slope.norm())) << degree << " " << k << " " << t;
      }
    }
  }
}

TEST(BSpline, ReproducesALineThatIsPassedAtItsVelocity) {
  for (int degree = 2; degree <= 5; ++degree) {
    const VectorXd times = numbers({0, 1, 2, 3});
    const BSpline spline(degree, times, times, numbers({1}), numbers({1}));
    EXPECT_NEAR(spline.eval(0., 1)[0], 1., 1e-12);
    EXPECT_NEAR(spline.eval(3. - 1e-9, 1)[0], 1., 1e-7);
    if (degree > 2) EXPECT_NEAR(spline.eval(0., 2)[0], 0., 1e-12) << degree;
  }
}

TEST(BSpline, StartsAndEndsAtItsPointsAtRest) {
  Rng rng(4);
  for (int degree = 2; degree <= 7; ++degree) {
    const BSpline spline = randomSpline(rng, degree, 5, 2);
    const double last = spline.end() - 1e-10;
    EXPECT_LT((spline.eval(last) - spline.eval(spline.end())).norm(), 1e-8);
    EXPECT_LT(spline.eval(spline.start(), 1).norm(), 1e-12);
    EXPECT_LT(spline.eval(last, 1).norm(), 1e-6) << degree;
    EXPECT_EQ(spline.eval(spline.end() + 1., 1).norm(), 0.);
  }
}

TEST(BSpline, AppendedAtRestItPassesThroughItsEndAndBeginsAnewThere) {
  Rng rng(5);
  for (int degree = 1; degree <= 6; ++degree) {
    const BSpline first = randomSpline(rng, degree, 4, 2);
    BSpline both = first;
    both.append(MatrixXd::Random(3, 2), numbers({.5, 1., 1.7}));
    EXPECT_NEAR(both.end(), first.end() + 1.7, 1e-12);
    EXPECT_LT((both.eval(first.end()) - first.eval(first.end())).norm(), 1e-12) << degree;
    if (degree > 1) EXPECT_LT(both.eval(first.end(), 1).norm(), 1e-10) << degree;
    EXPECT_EQ(both.getKnots().size(), both.getCtrlPoints().rows() + degree + 1);
    for (double part : {.1, .5, .9}) {
      if (degree > 3) continue;  // higher degrees have a smoother joint than two separate motions
      const double t = first.start() + part * (first.end() - first.start());
      EXPECT_LT((both.eval(t) - first.eval(t)).norm(), 1e-12) << degree << " " << t;
    }
  }
}

TEST(BSpline, AppendedInMotionItKeepsItsVelocityAndWhatItWas) {
  Rng rng(6);
  for (int degree = 2; degree <= 5; ++degree) {
    const BSpline first = randomSpline(rng, degree, 4, 2, true);
    BSpline both = first;
    both.append(MatrixXd::Random(2, 2), numbers({.5, 1.}));
    const double end = first.end(), h = 1e-9;
    EXPECT_LT((both.eval(end, 1) - first.eval(end - h, 1)).norm(), 1e-5) << degree;
    for (double t = first.start(); t < end; t += .1) EXPECT_LT((both.eval(t) - first.eval(t)).norm(), 1e-12);
  }
}

TEST(BSpline, OverwrittenItGoesOnFromWhereItIsAsFastAsItIs) {
  Rng rng(7);
  for (int degree = 2; degree <= 4; ++degree) {
    const BSpline before = randomSpline(rng, degree, 6, 3);
    const double cut = before.start() + .4 * (before.end() - before.start());
    BSpline after = before;
    after.overwriteSmooth(MatrixXd::Random(2, 3), numbers({.3, 1.}), cut);
    EXPECT_LT((after.eval(cut) - before.eval(cut)).norm(), 1e-12);
    EXPECT_LT((after.eval(cut, 1) - before.eval(cut, 1)).norm(), 1e-10);
  }
}

TEST(BSpline, TheMatrixTimesThePointsIsTheMotion) {
  Rng rng(8);
  for (int degree = 0; degree <= 5; ++degree) {
    const BSpline spline = randomSpline(rng, degree, 5, 2);
    const VectorXd times = VectorXd::LinSpaced(40, spline.start() - .2, spline.end() + .2);
    const MatrixXd points = spline.getCtrlPoints();
    EXPECT_LT((spline.getBmatrix(times) * points - spline.eval(times)).norm(), 1e-12);
    const MatrixXd inner = points.middleRows(degree / 2, 5);
    EXPECT_LT((spline.getBmatrix(times, true, true) * inner - spline.eval(times)).norm(), 1e-12);
    EXPECT_LT((spline.getBmatrix(times, false, false, 1) * points - spline.eval(times, 1)).norm(), 1e-10);
    EXPECT_LT((spline.getBmatrix(times).rowwise().sum().array() - 1.).matrix().norm(), 1e-12);
  }
}

TEST(BSpline, OfDegreeZeroIsTheNearestPoint) {
  const BSpline steps(0, numbers({3, 5, 7}), numbers({0, 1, 3}));
  expectNear(steps.eval(numbers({-1, 0, .4, .6, 1.9, 2.1, 3, 4})), {3, 3, 3, 5, 5, 7, 7, 7});
  expectNear(steps.eval(numbers({.4}), 1), {0});
}

TEST(BSpline, OfDegreeOneIsTheLinesBetweenItsPoints) {
  const BSpline lines(1, numbers({0, 1, -1}), numbers({0, 1, 3}));
  expectNear(lines.eval(numbers({.5, 1, 2, 3})), {.5, 1, 0, -1});
  expectNear(lines.eval(numbers({.5, 1, 2}), 1), {1, -1, -1});
}

TEST(BSpline, SaysWhatIsWrongAndStaysAsItWas) {
  BSpline spline = line();
  const auto unchanged = [&] {
    expectNear(spline.getKnots(), {0, 0, 0, .5, 1, 1, 1});
    expectNear(spline.getCtrlPoints(), {0, 0, 1, 1});
  };
  const VectorXd two = numbers({0, 1});
  expectError<ValueError>([&] { spline.set(2, two, numbers({0, 1, 2})); }, {"2 points and 3 times"});
  expectError<ValueError>([&] { spline.set(2, two, numbers({1, 0})); }, {"times[1] = 0 is before 1"});
  expectError<ValueError>([&] { spline.set(2, two, numbers({1, 1})); }, {"all times are 1"});
  expectError<ValueError>([&] { spline.set(10, two, two); }, {"degree is 10; expected 0 to 9"});
  expectError<ValueError>([&] { spline.set(1, two, two, numbers({1})); }, {"degree 1 has no start velocity"});
  expectError<ValueError>([&] { spline.set(2, two, two, {}, two); }, {"end velocity has 2 numbers; expected 1"});
  expectError<ValueError>([&] { spline.set(2, numbers({0, NAN}), two); }, {"not finite"});
  expectError<ValueError>([&] { spline.append(two, numbers({1, .5})); }, {"times[1] = 0.5 is before 1"});
  expectError<ValueError>([&] { spline.append(two, numbers({-1, .5})); }, {"times[0] = -1 is before 0"});
  expectError<ValueError>([&] { spline.append(MatrixXd::Zero(1, 2), numbers({1})); },
                          {"points have 2 numbers; expected 1"});
  expectError<ValueError>([&] { spline.overwriteSmooth(two, numbers({1}), 0.); }, {"points"});
  expectError<ValueError>([&] { spline.eval(0., -1); }, {"derivative is -1"});
  expectError<ValueError>([] { BSpline().eval(0.); }, {"no control points yet"});
  expectError<ValueError>([] { BSpline().setCtrlPoints(MatrixXd::Zero(2, 1)); }, {"no knots yet"});
  unchanged();
}
