#include "kinegraph/planning/acceleration_ramp.h"

#include <gtest/gtest.h>

namespace kinegraph {
namespace {

const VectorXd kStart{{.2, -1., 3.}}, kVelocity{{.5, -.3, .8}}, kAcceleration{{2., 0., -1.}};
const MotionLimits kLimits{VectorXd::Constant(3, 1.), VectorXd::Constant(3, 4.), VectorXd::Constant(3, 30.)};

TEST(EasedStart, AtAConstantSpeedItHasTheVelocityAndTheAccelerationOfTheStart) {
  const EasedStart eased = easeOff(kStart, kVelocity, kAcceleration, kLimits);
  const double speed = eased.velocity.norm();
  EXPECT_TRUE(eased.curve.eval(0.).isApprox(kStart, 1e-12));
  EXPECT_TRUE((speed * eased.curve.eval(0., 1)).isApprox(kVelocity, 1e-12));
  EXPECT_TRUE((speed * speed * eased.curve.eval(0., 2)).isApprox(kAcceleration, 1e-12));
  const double end = eased.curve.length();
  EXPECT_TRUE(eased.curve.eval(end).isApprox(eased.q, 1e-12));
  EXPECT_TRUE((speed * eased.curve.eval(end, 1)).isApprox(eased.velocity, 1e-9));
  EXPECT_LE(eased.curve.eval(end, 2).norm(), 1e-9);
  for (int piece = 0; piece < eased.curve.pieces(); ++piece) {
    const Eigen::Map<const VectorXd> cubic(eased.curve.coefficient(piece, 3), 3);
    EXPECT_LE(6. * speed * speed * speed * cubic.cwiseAbs().maxCoeff(), 30.);
  }
}

TEST(EasedStart, AVelocityThatGrowsIsKeptWithinItsLimit) {
  const VectorXd velocity{{.95}}, acceleration{{1.5}};  // 1.5^2 / (2 30) = .0375 more at the full jerk
  const MotionLimits limits{VectorXd::Constant(1, 1.), VectorXd::Constant(1, 4.), VectorXd::Constant(1, 30.)};
  EXPECT_LE(easeOff(VectorXd::Zero(1), velocity, acceleration, limits).velocity[0], 1.);
}

TEST(EasedStart, WhereItWouldStandStillThereIsNoCurve) {
  const VectorXd velocity{{.5}}, acceleration{{-std::sqrt(.5 * 30.)}};  // half of the jerk's limit brakes it
  const MotionLimits limits{VectorXd::Constant(1, 1.), VectorXd::Constant(1, 4.), VectorXd::Constant(1, 30.)};
  EXPECT_EQ(easeOff(VectorXd::Zero(1), velocity, acceleration, limits).curve.pieces(), 0);
}

TEST(EasedStart, BernsteinCoefficientsHoldThePiece) {
  const EasedStart eased = easeOff(kStart, kVelocity, kAcceleration, kLimits);
  for (int piece = 0; piece < eased.curve.pieces(); ++piece) {
    const std::vector<VectorXd> points = bernsteinOf(eased.curve, piece);
    EXPECT_TRUE(points.front().isApprox(eased.curve.eval(eased.curve.begin(piece)), 1e-12));
    EXPECT_TRUE(points.back().isApprox(eased.curve.eval(eased.curve.end(piece)), 1e-12));
    VectorXd low = points[0], high = points[0];
    for (const VectorXd& point : points) low = low.cwiseMin(point), high = high.cwiseMax(point);
    for (int i = 0; i <= 20; ++i) {
      const double s = eased.curve.begin(piece) + i / 20. * (eased.curve.end(piece) - eased.curve.begin(piece));
      const VectorXd q = eased.curve.eval(s);
      EXPECT_TRUE(((q - low).array() >= -1e-12).all() && ((high - q).array() >= -1e-12).all());
    }
  }
}

}  // namespace
}  // namespace kinegraph
