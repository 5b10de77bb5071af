#include "kinegraph/trajectories/spline_part.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"
#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

VectorXd numbers(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), Eigen::Index(values.size()));
}

BSpline wave(int degree) {
  MatrixXd points(5, 2);
  points << 0., 1., 2., -1., .5, .3, 1., 2., -1., 0.;
  return BSpline(degree, points, numbers({.5, .8, 1.7, 2., 3.1}));
}

TEST(CubicPart, IsTheSameMotionForAllDegrees) {
  Rng rng(0);
  for (int degree = 1; degree <= 3; ++degree) {
    const BSpline motion = wave(degree);
    for (int i = 0; i < 20; ++i) {
      const double from = rng.uniform(-.5, 3.), until = from + rng.uniform(.01, 2.);
      const BSpline part = cubicPart(motion, from, until);
      EXPECT_EQ(part.degree(), 3);
      EXPECT_EQ(part.start(), from);
      EXPECT_EQ(part.end(), until);
      for (int k = 0; k < 50; ++k) {
        const double t = from + (until - from) * (k + .5) / 50.;
        for (int derivative = 0; derivative <= degree; ++derivative)
          EXPECT_LT((part.eval(t, derivative) - motion.eval(t, derivative)).norm(), 1e-9) << degree << " " << t;
      }
    }
  }
}

TEST(CubicPart, WhatIsAppendedGoesOnWithItsVelocity) {
  const BSpline motion = wave(3);
  BSpline part = cubicPart(motion, 1., 1.9);
  MatrixXd further(2, 2);
  further << 0., 0., 1., 1.;
  part.append(further, numbers({.5, 1.}));
  EXPECT_EQ(part.end(), 2.9);
  for (const double t : {1.2, 1.7, 1.8, 1.899}) EXPECT_LT((part.eval(t) - motion.eval(t)).norm(), 1e-12) << t;
  EXPECT_LT((part.eval(1.9) - motion.eval(1.9)).norm(), 1e-12);
  EXPECT_LT((part.eval(1.9, 1) - motion.eval(1.9, 1)).norm(), 1e-9);
  EXPECT_EQ(part.eval(2.9), further.row(1).transpose());
}

TEST(CubicPart, StandsStillBeforeAndAfterAMotion) {
  const BSpline motion = wave(2);
  BSpline part = cubicPart(motion, 4., 5.);
  EXPECT_EQ(part.eval(4.5), motion.eval(9.));
  part.append(numbers({1., 1.}).transpose(), numbers({1.}));
  EXPECT_LT((part.eval(4.9) - motion.eval(9.)).norm(), 1e-15) << "and still does when something is appended";
  EXPECT_EQ(part.eval(5., 1), VectorXd::Zero(2));
  EXPECT_LT((cubicPart(motion, -1., .4).eval(0.) - motion.eval(.5)).norm(), 1e-12);
}

TEST(CubicPart, RefusesWhatItCannotCut) {
  expectError<ValueError>([] { cubicPart(wave(4), 1., 2.); }, {"the degree is 4"});
  expectError<ValueError>([] { cubicPart(wave(3), 1., 1.); }, {"from 1 until 1"});
}

}  // namespace
}  // namespace kinegraph
