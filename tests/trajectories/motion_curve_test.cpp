#include "kinegraph/trajectories/motion_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/trajectories/retime.h"

using namespace kinegraph;

namespace {

BSpline splineOf(int degree, const MatrixXd& points) {
  return BSpline(degree, points, VectorXd::LinSpaced(points.rows(), 0., 1.));
}

MatrixXd threePoints() {
  MatrixXd points(3, 2);
  points << 0., 0., 1., 0., 1., 1.;
  return points;
}

}  // namespace

TEST(MotionCurve, IsNearASplineThatRestsAtItsEnds) {
  const SplineTrajectory motion(splineOf(3, threePoints()));
  const PathCurve curve = curveOf(motion);
  for (int piece = 1; piece < curve.pieces(); ++piece) EXPECT_FALSE(curve.stopsAt(piece));
  for (int k = 0; k <= 777; ++k) {
    const VectorXd q = motion.eval(k / 777.).q;
    double near = 1.;
    for (int i = 0; i <= 4000; ++i) near = std::min(near, (curve.eval(curve.length() * i / 4000.) - q).norm());
    EXPECT_LT(near, 3e-4);  // half a step of the samples
  }
  EXPECT_LT(curve.pieces(), 100);
}

TEST(MotionCurve, HasACornerWhereTheDirectionJumps) {
  const PathCurve curve = curveOf(SplineTrajectory(splineOf(1, threePoints())));
  EXPECT_NEAR(curve.length(), 2., 1e-6);
  int corners = 0;
  for (int piece = 1; piece < curve.pieces(); ++piece) {
    if (!curve.stopsAt(piece)) continue;
    ++corners;
    EXPECT_LT((curve.eval(curve.begin(piece)) - Eigen::Vector2d(1., 0.)).norm(), 1e-6);
  }
  EXPECT_EQ(corners, 1);
}

TEST(MotionCurve, IsThatOfATimedPath) {
  const MotionLimits limits{Eigen::Vector2d(1., 1.), Eigen::Vector2d(2., 2.), {}};
  const TimedPath timed = retime(threePoints(), limits, {.corners = Corners::stop});
  EXPECT_EQ(curveOf(timed).parts().coefficients, timed.curve().parts().coefficients);
}
