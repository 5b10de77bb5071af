#include "kinegraph/tool_paths/tool_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kinegraph/common/errors.h"

namespace kinegraph {
namespace {

constexpr double kQuarter = std::numbers::pi / 2.;
constexpr double kExact = 1e-9, kHermite = 2e-7;

Pose poseAt(double x, double y, double z, double about_z = 0.) {
  return {Vector3d(x, y, z), Quaterniond(Eigen::AngleAxisd(about_z, Vector3d::UnitZ()))};
}

constexpr ToolTolerance kFit{5e-6, 5e-5};

ToolCurve curveOfPath(const ToolPath& path) { return ToolCurve(path, Pose(), kFit); }

TEST(ToolCurve, ALineHasItsLengthAndTurnsAtAConstantRate) {
  const ToolCurve curve = curveOfPath(ToolPath("tool").start(poseAt(0., 0., 0.)).line(poseAt(.3, .4, 0., 1.)));
  EXPECT_NEAR(curve.length(), .5, kExact);
  const ToolTarget middle = curve.at(.25);
  EXPECT_LT((middle.p - Vector3d(.15, .2, 0.)).norm(), kExact);
  EXPECT_LT((middle.x - Vector3d(std::cos(.5), std::sin(.5), 0.)).norm(), kHermite);
  EXPECT_TRUE(curve.corners().empty());
}

TEST(ToolCurve, ARotationOnTheSpotHasAWayOfItsOwn) {
  const ToolCurve curve = curveOfPath(ToolPath("tool").start(poseAt(1., 0., 0.)).line(poseAt(1., 0., 0., 2.)));
  EXPECT_NEAR(curve.length(), 2. * ToolCurve::kOnTheSpot, kExact);
  EXPECT_LT((curve.at(.1).x - Vector3d(std::cos(1.), std::sin(1.), 0.)).norm(), kHermite);
}

TEST(ToolCurve, AnArcThroughThreePointsIsOnItsCircle) {
  const ToolCurve curve =
      curveOfPath(ToolPath("tool").start(poseAt(.1, 0., 0.)).arc(Vector3d(0., .1, 0.), Vector3d(-.1, 0., 0.)));
  EXPECT_NEAR(curve.length(), .1 * std::numbers::pi, kHermite);
  for (int k = 0; k <= 100; ++k) {
    const double s = curve.length() * k / 100.;
    EXPECT_LT((curve.at(s).p - .1 * Vector3d(std::cos(10. * s), std::sin(10. * s), 0.)).norm(), kHermite);
  }
}

TEST(ToolCurve, ACircleOfANegativeAngleGoesTheOtherWay) {
  const ToolCurve curve = curveOfPath(
      ToolPath("tool").start(poseAt(.2, 0., .5)).circle(Vector3d::Zero(), 3. * Vector3d::UnitZ(), -kQuarter));
  EXPECT_LT((curve.at(curve.length()).p - Vector3d(0., -.2, .5)).norm(), kHermite);
}

TEST(ToolCurve, StopsAtCornersOnly) {
  ToolPath path("tool");
  path.start(poseAt(0., 0., 0.)).line(poseAt(.1, 0., 0.)).line(poseAt(.2, 0., 0.)).line(poseAt(.2, .1, 0.));
  const std::vector<double> corners = curveOfPath(path).corners();
  ASSERT_EQ(corners.size(), 1u);
  EXPECT_NEAR(corners[0], .2, kExact);
}

TEST(ToolCurve, ABlendStaysWithinItsRadiusAndHasNoCorner) {
  ToolPath path("tool");
  path.start(poseAt(0., 0., 0.)).line(poseAt(.1, 0., 0.)).line(poseAt(.1, .1, 0.), .02);
  const ToolCurve curve = curveOfPath(path);
  EXPECT_TRUE(curve.corners().empty());
  EXPECT_TRUE(curve.warnings().empty());
  EXPECT_LT(curve.length(), .2);
  const Vector3d corner(.1, 0., 0.);
  for (int k = 0; k <= 1000; ++k) {
    const Vector3d p = curve.at(curve.length() * k / 1000.).p;
    const double to_lines =
        std::min(std::hypot(p[1], std::max(0., p[0] - .1)), std::hypot(p[0] - .1, std::min(0., p[1])));
    if ((p - corner).norm() > .02 + kHermite) EXPECT_LT(to_lines, kHermite);
    EXPECT_LT(p[0], .1 + kHermite);  // within the corner
    EXPECT_GT(p[1], -kHermite);
  }
}

TEST(ToolCurve, BlendsThatOverlapShrinkWithAWarning) {
  ToolPath path("tool");
  path.start(poseAt(0., 0., 0.))
      .line(poseAt(.1, 0., 0.), 0.)
      .line(poseAt(.1, .03, 0.), .05)
      .line(poseAt(.2, .03, 0.), .05);
  const ToolCurve curve = curveOfPath(path);
  ASSERT_EQ(curve.warnings().size(), 2u);
  EXPECT_NE(curve.warnings()[1].find("at element 2 is reduced to 0.0147 m"), std::string::npos) << curve.warnings()[1];
  EXPECT_TRUE(curve.corners().empty());
  for (int piece = 0; piece < curve.pieces().pieces(); ++piece)  // some of the short line remains
    EXPECT_GT(curve.pieces().end(piece) - curve.pieces().begin[std::size_t(piece)], 1e-5);
}

TEST(ToolCurve, BlendsWithoutEffectAreReported) {
  ToolPath path("tool");
  path.start(poseAt(0., 0., 0.)).line(poseAt(.1, 0., 0.), .01).spline({poseAt(.2, .1, 0.), poseAt(.3, 0., 0.)});
  path.line(poseAt(.4, 0., 0.), .02);
  const ToolCurve curve(path, Pose(), kFit, .05);
  ASSERT_EQ(curve.warnings().size(), 2u);
  EXPECT_EQ(curve.warnings()[0].find("the blend of 0.01 m at element 0 has no effect"), 0u) << curve.warnings()[0];
  EXPECT_EQ(curve.warnings()[1].find("the blend of 0.02 m at element 2 has no effect"), 0u) << curve.warnings()[1];
  EXPECT_LT(curve.at(curve.approachEnd()).p.norm(), kExact);  // the approach does not cut the start
}

TEST(ToolCurve, RowsWithRoundingGiveASmoothCurve) {
  MatrixXd points(801, 3), normals(801, 3);
  for (int k = 0; k <= 800; ++k) {  // an arc of radius .1, a row every .25 mm, rounded to 1 um
    const double a = k * .0025;
    points.row(k) << std::round(1e5 * std::cos(a)) * 1e-6, std::round(1e5 * std::sin(a)) * 1e-6, 0.;
    normals.row(k) << 0., 0., 1.;
  }
  const ToolCurve curve = curveOfPath(ToolPath::along("tool", points, normals).free());
  EXPECT_NEAR(curve.length(), .2, 1e-5);
  double bend = 0.;
  for (int k = 0; k <= 500; ++k) {
    const double s = curve.length() * k / 500.;
    EXPECT_NEAR(curve.at(s).p.norm(), .1, 5e-6 + 1e-6);
    bend = std::max(bend, curve.pieces().eval(s, 2).head<3>().norm());
  }
  EXPECT_LT(bend, 12.);  // the curvature is 10; polylines of the rows would have thousands
  EXPECT_LT(curve.fitError().position, 5e-6);
}

TEST(ToolCurve, FewRowsAtRightAnglesAreLinesWithCorners) {
  MatrixXd points(4, 3);
  points << 0., 0., 0., .1, 0., 0., .1, .1, 0., 0., .1, 0.;
  const ToolCurve curve = curveOfPath(ToolPath::along("tool", points));
  EXPECT_NEAR(curve.length(), .3, kExact);
  EXPECT_EQ(curve.corners().size(), 2u);
  EXPECT_LT((curve.at(.25).p - Vector3d(.05, .1, 0.)).norm(), kExact);
}

TEST(ToolCurve, NoiseWithinTheToleranceGivesNoCorners) {
  MatrixXd points(301, 3);
  for (int k = 0; k <= 300; ++k)  // a right angle, a row every .5 mm, with noise of .3 mm
    points.row(k) << std::min(k, 150) * 5e-4, std::max(k - 150, 0) * 5e-4, 3e-4 * std::sin(double(37 * k * k));
  const ToolPath path = ToolPath::along("tool", points);
  EXPECT_GT(curveOfPath(path).corners().size(), 50u);
  EXPECT_EQ(ToolCurve(path, Pose(), {6e-4, 1e-3}).corners().size(), 1u);
  EXPECT_NEAR(ToolCurve(path, Pose(), {6e-4, 1e-3}).corners()[0], .075, .002);
}

TEST(ToolCurve, TheReversedCurveIsTheSamePlaceByPlace) {
  ToolPath path("tool");
  path.start(poseAt(0., 0., 0.)).line(poseAt(.1, 0., 0., .5)).arc(Vector3d(.15, .05, 0.), poseAt(.2, 0., .1, 1.));
  const ToolCurve curve = curveOfPath(path), back = curve.reversed();
  ASSERT_EQ(curve.corners().size(), back.corners().size());
  for (int k = 0; k <= 50; ++k) {
    const double s = curve.length() * (k + .5) / 51.;
    EXPECT_LT((curve.at(s).p - back.at(curve.length() - s).p).norm(), kExact);
    EXPECT_LT((curve.at(s).x - back.at(curve.length() - s).x).norm(), kExact);
  }
}

TEST(ToolCurve, ApproachAndRetractAreAlongTheFreeAxis) {
  ToolPath path("tool");
  path.start(poseAt(0., 0., 0.)).line(poseAt(.1, 0., 0.)).free(2);
  const ToolCurve curve(path, Pose(), kFit, .02, .03);
  EXPECT_NEAR(curve.approachEnd(), .02, kExact);
  EXPECT_NEAR(curve.retractStart(), .12, kExact);
  EXPECT_NEAR(curve.length(), .15, kExact);
  EXPECT_LT((curve.at(0.).p - Vector3d(0., 0., .02)).norm(), kExact);
  EXPECT_LT((curve.at(.15).p - Vector3d(.1, 0., .03)).norm(), kExact);
  EXPECT_EQ(curve.corners().size(), 2u);
}

TEST(ToolCurve, RejectsPathsWithoutLengthAndArcsOnALine) {
  EXPECT_THROW(curveOfPath(ToolPath("tool")), ValueError);
  EXPECT_THROW(curveOfPath(ToolPath("tool").line(Vector3d(0., 0., 0.))), ValueError);
  EXPECT_THROW(curveOfPath(ToolPath("tool").arc(Vector3d(1., 0., 0.), Vector3d(2., 0., 0.))), ValueError);
}

TEST(ToolCurve, PathsThatNoMemoryHoldsAreRefused) {
  const ToolPath start = ToolPath("tool").start(poseAt(.1, 0., 0.));
  const auto circle = [&](double angle) { return ToolPath(start).circle(Vector3d::Zero(), Vector3d::UnitZ(), angle); };
  EXPECT_THROW(curveOfPath(ToolPath(start).line(poseAt(1e7, 0., 0.))), ValueError);
  EXPECT_THROW(curveOfPath(ToolPath(start).line(poseAt(1e300, 0., 0.)).line(poseAt(-1e300, 0., 0.))), ValueError);
  EXPECT_THROW(curveOfPath(circle(1e300)), ValueError);
  EXPECT_THROW(curveOfPath(circle(9e4)), ValueError);
  EXPECT_THROW(curveOfPath(ToolPath(start).spline({poseAt(1e9, 0., 0.), poseAt(0., 1., 0.)})), ValueError);
  ToolPath many(start);
  for (int k = 0; k < 20; ++k) many.line(poseAt(k % 2 ? 0. : 999., 0., 0.));
  EXPECT_THROW(curveOfPath(many), ValueError);
  EXPECT_NEAR(curveOfPath(circle(100.)).length(), 10., 1e-4);
}

}  // namespace
}  // namespace kinegraph
