#include "kinegraph/planning/acceleration_ramp.h"

#include <gtest/gtest.h>

namespace kinegraph {
namespace {

const VectorXd kStart{{.2, -1., 3.}}, kVelocity{{.5, -.3, .8}}, kAcceleration{{2., 0., -1.}};
const MotionLimits kLimits{VectorXd::Constant(3, 1.), VectorXd::Constant(3, 4.), VectorXd::Constant(3, 30.)};

TEST(AccelerationRamp, AtAConstantSpeedItHasTheVelocityAndTheAccelerationOfTheStart) {
  const AccelerationRamp ramp = rampDown(kStart, kVelocity, kAcceleration, kLimits);
  const double speed = ramp.velocity.norm();
  EXPECT_TRUE(ramp.curve.eval(0.).isApprox(kStart, 1e-12));
  EXPECT_TRUE((speed * ramp.curve.eval(0., 1)).isApprox(kVelocity, 1e-12));
  EXPECT_TRUE((speed * speed * ramp.curve.eval(0., 2)).isApprox(kAcceleration, 1e-12));
  const double end = ramp.curve.length();
  EXPECT_TRUE(ramp.curve.eval(end).isApprox(ramp.q, 1e-12));
  EXPECT_TRUE((speed * ramp.curve.eval(end, 1)).isApprox(ramp.velocity, 1e-9));
  EXPECT_LE(ramp.curve.eval(end, 2).norm(), 1e-9);
  for (int piece = 0; piece < ramp.curve.pieces(); ++piece) {
    const Eigen::Map<const VectorXd> cubic(ramp.curve.coefficient(piece, 3), 3);
    EXPECT_LE(6. * speed * speed * speed * cubic.cwiseAbs().maxCoeff(), 30.);
  }
}

TEST(AccelerationRamp, AVelocityThatGrowsIsKeptWithinItsLimit) {
  const VectorXd velocity{{.95}}, acceleration{{1.5}};  // 1.5^2 / (2 30) = .0375 more at the full jerk
  const MotionLimits limits{VectorXd::Constant(1, 1.), VectorXd::Constant(1, 4.), VectorXd::Constant(1, 30.)};
  EXPECT_LE(rampDown(VectorXd::Zero(1), velocity, acceleration, limits).velocity[0], 1.);
}

TEST(AccelerationRamp, WhereItWouldStandStillThereIsNoCurve) {
  const VectorXd velocity{{.5}}, acceleration{{-std::sqrt(.5 * 30.)}};  // half of the jerk limit brakes it
  const MotionLimits limits{VectorXd::Constant(1, 1.), VectorXd::Constant(1, 4.), VectorXd::Constant(1, 30.)};
  EXPECT_EQ(rampDown(VectorXd::Zero(1), velocity, acceleration, limits).curve.pieces(), 0);
}

TEST(AccelerationRamp, BernsteinCoefficientsHoldThePiece) {
  const AccelerationRamp ramp = rampDown(kStart, kVelocity, kAcceleration, kLimits);
  for (int piece = 0; piece < ramp.curve.pieces(); ++piece) {
    const std::vector<VectorXd> points = bernsteinOf(ramp.curve, piece);
    EXPECT_TRUE(points.front().isApprox(ramp.curve.eval(ramp.curve.begin(piece)), 1e-12));
    EXPECT_TRUE(points.back().isApprox(ramp.curve.eval(ramp.curve.end(piece)), 1e-12));
    VectorXd low = points[0], high = points[0];
    for (const VectorXd& point : points) low = low.cwiseMin(point), high = high.cwiseMax(point);
    for (int i = 0; i <= 20; ++i) {
      const double s = ramp.curve.begin(piece) + i / 20. * (ramp.curve.end(piece) - ramp.curve.begin(piece));
      const VectorXd q = ramp.curve.eval(s);
      EXPECT_TRUE(((q - low).array() >= -1e-12).all() && ((high - q).array() >= -1e-12).all());
    }
  }
}

TEST(AccelerationRamp, ASmallAccelerationTakesItsTime) {
  const AccelerationRamp ramp = rampDown(kStart, kVelocity, .001 * kAcceleration, kLimits);
  EXPECT_NEAR(ramp.curve.length() / ramp.velocity.norm(), .02, 1e-9);
}

}  // namespace
}  // namespace kinegraph
