#include "kinegraph/robot/motion_limits.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"
#include "tests/robot/arm.h"

using namespace kinegraph;

namespace {

BSpline motion(Rng& rng, int points) {
  MatrixXd path(points, 2);
  for (double& x : path.reshaped()) x = rng.normal();
  VectorXd times(points);
  double t = 0.;
  for (double& time : times) time = t += .2 + rng.uniform();
  return BSpline(3, path, times);
}

}  // namespace

TEST(MotionPeaks, AreAsLargeAsTheLargestOfManySamplesAndHardlyLarger) {
  Rng rng(1);
  for (int i = 0; i < 20; ++i) {
    const BSpline spline = motion(rng, 5);
    const MotionPeaks peaks = peaksOf(spline, 0.);
    const VectorXd times = VectorXd::LinSpaced(20001, spline.start(), spline.end());
    const VectorXd v = spline.eval(times, 1).cwiseAbs().colwise().maxCoeff().transpose();
    const VectorXd a = spline.eval(times, 2).cwiseAbs().colwise().maxCoeff().transpose();
    for (int j = 0; j < 2; ++j) {
      EXPECT_GE(peaks.velocity[j], v[j] - 1e-12);
      EXPECT_LE(peaks.velocity[j], v[j] * (1 + 1e-5));
      EXPECT_GE(peaks.acceleration[j], a[j] - 1e-12);
      EXPECT_LE(peaks.acceleration[j], a[j] * (1 + 1e-2));  // at a jump, the nearest sample is off the knot
      EXPECT_NEAR(std::abs(spline.eval(peaks.velocity_time[j], 1)[j]), peaks.velocity[j], 1e-9);
    }
  }
}

TEST(MotionPeaks, OfAMotionFromRestToRestAreThoseOnPaper) {
  MatrixXd points(2, 1);
  points << 0., 2.;
  const MotionPeaks peaks = peaksOf(BSpline(3, points, pair(0., 4.)), 0.);  // 3 s^2 - 2 s^3 of 2 in 4 s
  EXPECT_NEAR(peaks.velocity[0], 1.5 * 2. / 4., 1e-12);
  EXPECT_NEAR(peaks.velocity_time[0], 2., 1e-12);
  EXPECT_NEAR(peaks.acceleration[0], 6. * 2. / 16., 1e-12);
  EXPECT_NEAR(peaks.slowdown(VectorXd::Constant(1, .375), VectorXd::Constant(1, 1e3)), 2., 1e-12);
  EXPECT_NEAR(peaks.slowdown(VectorXd::Constant(1, 1e3), VectorXd::Constant(1, .75 / 4.)), 2., 1e-12);
}

TEST(ViolatedLimit, NamesTheJointTheTimeAndTheFactorThatWouldDo) {
  RobotInfo robot = plainRobot();
  MatrixXd points(2, 2);
  points << 0., 0., 0., 1.;
  const BSpline spline(3, points, pair(0., 1.));  // 1.5 rad/s at .5 s
  EXPECT_FALSE(violatedLimit(spline, 0., robot));
  robot.velocity[1] = 1.;
  const std::string slow = violatedLimit(spline, 0., robot).value();
  EXPECT_EQ(slow,
            "joint 'arm2' would have a velocity of 1.5 /s 0.5 s after the start of the motion; its limit is 1 /s; take "
            "at least 1.5 times as long");
  EXPECT_FALSE(violatedLimit(BSpline(3, points, pair(0., 1.5)), 0., robot));  // and it does
  robot.velocity[1] = 2.;
  robot.acceleration[1] = 3.;
  EXPECT_NE(violatedLimit(spline, 0., robot).value().find("limit is 3 /s^2"), std::string::npos);
  robot.acceleration[1] = 7.;
  robot.upper[1] = .9;
  EXPECT_EQ(violatedLimit(spline, 0., robot).value(), "joint 'arm2' would go to 1; its limits are -inf to 0.9");
}

TEST(ViolatedLimit, ChecksTheMotionAndNotItsControlPoints) {
  RobotInfo robot = plainRobot();
  MatrixXd points(3, 2);
  points << 0., 0., 1., 0., 0., 0.;
  const BSpline spline(3, points, Vector3d(0., 1., 2.));
  const double top = spline.eval(1.)[0];
  EXPECT_LT(top, .7);
  robot.upper[0] = top + .01;
  EXPECT_FALSE(violatedLimit(spline, 0., robot));
  robot.upper[0] = top - .01;
  EXPECT_TRUE(violatedLimit(spline, 0., robot));
}

TEST(ViolatedEffort, IsThatOfAPendulumHeldLevel) {
  Config C;
  C.addText(
      "base: {}\narm1 (base): { joint: hingeY }\narm2 (arm1): { joint: transX }\nmass (arm2): { Q: [1 0 0], mass: 2 }");
  RobotInfo robot = plainRobot();
  MatrixXd points = MatrixXd::Zero(2, 2);
  const BSpline still(3, points, pair(0., 1.));
  robot.effort[0] = 19.7;  // 2 kg at 1 m: 19.62 N m
  EXPECT_FALSE(violatedEffort(still, 0., .01, robot, C));
  robot.effort[0] = 19.5;
  const std::string broken = violatedEffort(still, 0., .01, robot, C).value();
  EXPECT_NE(broken.find("'arm1' would have an effort of 19.62 N m"), std::string::npos) << broken;
}
