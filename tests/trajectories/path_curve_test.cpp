#include "kinegraph/trajectories/path_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"
#include "kinegraph/trajectories/retime.h"

using namespace kinegraph;

namespace {

/// The largest distance of a spline from the lines between its points, relative to the length of the line.
double deviation(const MatrixXd& points) {
  const PathCurve curve = cubicSpline(points);
  double most = 0.;
  VectorXd q(points.cols()), end(points.cols());
  for (int piece = 0; piece < curve.pieces(); ++piece) {
    const double begin = curve.begin(piece), length = curve.end(piece) - begin;
    const VectorXd start = curve.eval(begin);
    curve.eval(piece, begin + length, 0, end.data());
    for (int k = 0; k <= 20; ++k) {
      curve.eval(piece, begin + length * k / 20., 0, q.data());
      most = std::max(most, (q - start - k / 20. * (end - start)).norm() / length);
    }
  }
  return most;
}

}  // namespace

TEST(PathCurve, AnEmptyCurveHasNoPointsAndSaysSo) {
  EXPECT_THROW(PathCurve().eval(0.), ValueError);
  EXPECT_THROW(TimedPath().curve().eval(.5, 1), ValueError);
  double out[1];
  EXPECT_THROW(polyline(Eigen::Vector2d(0., 1.)).eval(1, .5, 0, out), ValueError);
}

TEST(PathCurve, ASplineStaysNearItsPointsForAnySpacing) {
  Rng rng(0);
  for (int trial = 0; trial < 500; ++trial) {
    MatrixXd points = MatrixXd::Zero(3 + trial % 6, 2);
    for (int i = 1; i < points.rows(); ++i) {
      const double angle = rng.uniform(0., 6.28), length = std::pow(10., rng.uniform(-6., 0.));
      points.row(i) = points.row(i - 1) + length * Eigen::RowVector2d(std::cos(angle), std::sin(angle));
    }
    EXPECT_LT(deviation(points), 2.) << points;
  }
}

TEST(PathCurve, ASplineThroughEvenPointsOfACubicIsThatCubic) {
  MatrixXd points(7, 1);
  for (int i = 0; i < 7; ++i) points(i, 0) = i;  // s is the length along the points
  points.conservativeResize(7, 2);
  points.col(1).setZero();
  EXPECT_LT(deviation(points), 1e-12);
  points.col(1) << 0., .001, .002, .003, .002, .001, 0.;
  const PathCurve curve = cubicSpline(points);
  EXPECT_NEAR(curve.eval(1e-9, 3)[1], curve.eval(curve.begin(1) + 1e-9, 3)[1], 1e-9);  // not-a-knot
}
