#include "kinegraph/trajectories/motion_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
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

/// Two legs at a right angle, each from rest to rest in `leg` s by a polynomial of degree 5.
class TwoLegs : public Trajectory {
 public:
  explicit TwoLegs(double leg) : leg_(leg) {}
  int dimension() const override { return 2; }
  double duration() const override { return 2. * leg_; }

  void evalTo(double t, double* q, double* velocity, double* acceleration) const override {
    for (int j = 0; j < 2; ++j) {
      const double u = std::clamp(t / leg_ - j, 0., 1.);
      q[j] = u * u * u * (10. - 15. * u + 6. * u * u);
      velocity[j] = 30. * u * u * (1. - u) * (1. - u) / leg_;
      acceleration[j] = 60. * u * (1. - u) * (1. - 2. * u) / (leg_ * leg_);
    }
  }

 private:
  double leg_;
};

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

TEST(MotionCurve, HasACornerWhereAMotionStopsSlowly) {
  for (const double leg : {1., 3., 7., 7.001}) {  // also with the corner between two samples
    const PathCurve curve = curveOf(TwoLegs(leg));
    EXPECT_NEAR(curve.length(), 2., 1e-6);
    int corners = 0;
    for (int piece = 1; piece < curve.pieces(); ++piece) {
      if (!curve.stopsAt(piece)) continue;
      ++corners;
      EXPECT_LT((curve.eval(curve.begin(piece)) - Eigen::Vector2d(1., 0.)).norm(), 1e-6) << leg;
    }
    EXPECT_EQ(corners, 1) << leg;
  }
}

TEST(MotionCurve, HasManyCorners) {
  constexpr int kCorners = 40;
  MatrixXd zigzag(kCorners + 2, 2);
  for (int k = 0; k < zigzag.rows(); ++k) zigzag.row(k) << (k + 1) / 2, k / 2;
  const PathCurve curve = curveOf(SplineTrajectory(splineOf(1, zigzag)));
  EXPECT_NEAR(curve.length(), kCorners + 1., 1e-4);
  EXPECT_EQ(curve.marks().front(), 0.);
  EXPECT_EQ(curve.marks().back(), curve.length());
  int corners = 0;
  for (int piece = 1; piece < curve.pieces(); ++piece) corners += curve.stopsAt(piece);
  EXPECT_EQ(corners, kCorners);
}

TEST(MotionCurve, IsThatOfATimedPath) {
  const MotionLimits limits{Eigen::Vector2d(1., 1.), Eigen::Vector2d(2., 2.), {}};
  const TimedPath timed = retime(threePoints(), limits, {.corners = Corners::stop});
  EXPECT_EQ(curveOf(timed).parts().coefficients, timed.curve().parts().coefficients);
}
