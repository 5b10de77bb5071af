#include "kinegraph/geometry/distance/closed_form/box_box_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kinegraph/geometry/distance/proximity.h"
#include "tests/support/box_samples.h"

using namespace kinegraph;
using namespace kinegraph::testing;

namespace {

const Vector3d kHalf(.3, .2, .1);

NearestPoints toBoxAtOrigin(const Matrix3d& R, const Vector3d& p, const Vector3d& half) {
  return boxToBox({{R, p}, half}, {{}, kHalf});
}

}  // namespace

TEST(BoxToBox, FacesThatFaceEachOtherAreNearestInTheMiddleOfTheSharedPart) {
  const NearestPoints near = toBoxAtOrigin(Matrix3d::Identity(), Vector3d(.4, .1, .5), Vector3d(.2, .2, .2));
  EXPECT_NEAR(near.distance, .2, kRounding);
  EXPECT_LT((near.normal - Vector3d::UnitZ()).norm(), kRounding);
  EXPECT_LT((near.point_a - Vector3d(.25, .05, .3)).norm(), kRounding);  // x from .2 to .3, y from -.1 to .2
  EXPECT_LT((near.point_b - Vector3d(.25, .05, .1)).norm(), kRounding);
}

TEST(BoxToBox, OverlappingByATenthOfAMeterGivesMinusATenth) {
  const NearestPoints near = toBoxAtOrigin(Matrix3d::Identity(), Vector3d(.6, 0, 0), Vector3d(.4, 1., 1.));
  EXPECT_NEAR(near.distance, -.1, kRounding);
  EXPECT_LT((near.normal - Vector3d::UnitX()).norm(), kRounding);
  EXPECT_NEAR(near.point_a.x(), .2, kRounding);
  EXPECT_NEAR(near.point_b.x(), .3, kRounding);
}

TEST(BoxToBox, ABoxInsideAnotherIsPushedOutAlongTheShortestDirection) {
  const NearestPoints near = toBoxAtOrigin(Matrix3d::Identity(), Vector3d(.05, .02, -.03), Vector3d(.01, .01, .01));
  EXPECT_NEAR(near.distance, -(.1 + .01 - .03), kRounding);
  EXPECT_LT((near.normal + Vector3d::UnitZ()).norm(), kRounding);
}

TEST(BoxToBox, ParallelEdgesAreNearestInTheMiddleOfTheSharedStretch) {
  const NearestPoints near = toBoxAtOrigin(Matrix3d::Identity(), Vector3d(.8, .3, .6), Vector3d(.2, .2, .1));
  EXPECT_NEAR(near.distance, .5, kRounding);  // gaps .3 in x and .4 in z
  EXPECT_LT((near.point_a - Vector3d(.6, .15, .5)).norm(), kRounding);
  EXPECT_LT((near.point_b - Vector3d(.3, .15, .1)).norm(), kRounding);
}

TEST(BoxToBox, CornersAreNearestOnTheDiagonal) {
  const NearestPoints near = toBoxAtOrigin(Matrix3d::Identity(), Vector3d(.6, .6, .6), Vector3d(.1, .2, .3));
  EXPECT_NEAR(near.distance, .2 * std::sqrt(3.), kRounding);
  EXPECT_LT((near.point_a - Vector3d(.5, .4, .3)).norm(), kRounding);
  EXPECT_LT((near.point_b - kHalf).norm(), kRounding);
}

TEST(BoxToBox, ACornerAboveAFaceIsNearestItsFoot) {
  // A cube of side 2 standing on a corner reaches sqrt(3) below its center.
  const Matrix3d R = Quaterniond::FromTwoVectors(Vector3d(-1, -1, -1), Vector3d(0, 0, -1)).toRotationMatrix();
  const NearestPoints near = toBoxAtOrigin(R, Vector3d(.1, .05, 2.), Vector3d(1, 1, 1));
  EXPECT_NEAR(near.distance, 1.9 - std::sqrt(3.), kRounding);
  EXPECT_LT((near.point_b - Vector3d(.1, .05, .1)).norm(), kRounding);
}

TEST(BoxToBox, CrossedEdgesAreNearestWhereTheyCross) {
  // Two cubes of side 2, each on an edge: one edge along x, the other along y.
  const Matrix3d on_x = axisRotation(0, std::atan(1.)), on_y = axisRotation(1, std::atan(1.));
  const double reach = std::sqrt(2.);
  for (const double gap : {.3, -.3}) {
    const NearestPoints near = boxToBox({{on_x, Vector3d(.2, .1, 2. * reach + gap)}, Vector3d(1, 1, 1)},
                                        {{on_y, Vector3d::Zero()}, Vector3d(1, 1, 1)});
    EXPECT_NEAR(near.distance, gap, kRounding);
    EXPECT_LT((near.normal - Vector3d::UnitZ()).norm(), kRounding);
    EXPECT_LT((near.point_a - Vector3d(0, .1, reach + gap)).norm(), kRounding);
    EXPECT_LT((near.point_b - Vector3d(0, .1, reach)).norm(), kRounding);
  }
}

TEST(BoxToBox, APlaneBetweenTheNearestPointsProvesTheDistance) {
  int apart = 0;
  for (const BoxPairSample& sample : boxPairs(4000, 1)) {
    const NearestPoints near = boxToBox(sample.a, sample.b);
    if (near.distance <= 0.) continue;
    ++apart;
    EXPECT_NEAR(near.normal.norm(), 1., kRounding) << sample.what;
    EXPECT_NEAR(-supportOf(sample.a, -near.normal) - supportOf(sample.b, near.normal), near.distance, kRounding)
        << sample.what;
    EXPECT_LT(distanceOutside(sample.a, near.point_a), kNearlyParallel) << sample.what;
    EXPECT_LT(distanceOutside(sample.b, near.point_b), kNearlyParallel) << sample.what;
  }
  EXPECT_GT(apart, 1000);
}

TEST(BoxToBox, TheDepthPartsTheBoxesAndNoShorterPushDoes) {
  Rng rng(2);
  int overlapping = 0;
  for (const BoxPairSample& sample : boxPairs(2000, 2)) {
    const NearestPoints near = boxToBox(sample.a, sample.b);
    if (near.distance >= 0.) continue;
    ++overlapping;
    const auto pushAlong = [&](const Vector3d& n) { return supportOf(sample.b, n) + supportOf(sample.a, -n); };
    EXPECT_NEAR(pushAlong(near.normal), -near.distance, kRounding) << sample.what;
    for (int i = 0; i < 50; ++i) {
      EXPECT_GE(pushAlong(randomVector(rng).normalized()), -near.distance - kIllConditioned) << sample.what;
      EXPECT_GE(pushAlong((near.normal + randomVector(rng, 1e-3)).normalized()), -near.distance - kIllConditioned)
          << sample.what;
    }
    EXPECT_LT(distanceOutside(sample.a, near.point_a), kNearlyParallel) << sample.what;
    EXPECT_LT(distanceOutside(sample.b, near.point_b), kNearlyParallel) << sample.what;
  }
  EXPECT_GT(overlapping, 300);
}

TEST(BoxToBox, WitnessPointsLieTheDistanceApartAlongTheNormal) {
  for (const BoxPairSample& sample : boxPairs(1000, 3)) {
    const NearestPoints near = boxToBox(sample.a, sample.b);
    EXPECT_LT((near.point_a - near.point_b - near.distance * near.normal).norm(), kRounding) << sample.what;
  }
}

TEST(BoxToBox, AgreesWithTheGeneralAlgorithmOnTheHullsOfTheCorners) {
  for (const BoxPairSample& sample : boxPairs(500, 4)) {
    if (sample.a.half.minCoeff() == 0. || sample.b.half.minCoeff() == 0.) continue;
    const auto hull_a = makeCollisionBody(sweptHullOf(boxCorners(sample.a.half), 0.));
    const auto hull_b = makeCollisionBody(sweptHullOf(boxCorners(sample.b.half), 0.));
    const Proximity general = proximity(*hull_a, sample.a.X_WB, *hull_b, sample.b.X_WB);
    EXPECT_NEAR(boxToBox(sample.a, sample.b).distance, general.distance, kGeneral) << sample.what;
  }
}

TEST(BoxToBox, SwappingTheBoxesSwapsThePointsAndNegatesTheNormal) {
  for (const BoxPairSample& sample : boxPairs(1000, 5)) {
    const NearestPoints ab = boxToBox(sample.a, sample.b), ba = boxToBox(sample.b, sample.a).swapped();
    EXPECT_NEAR(ab.distance, ba.distance, ab.distance > 0. ? kRounding : kIllConditioned) << sample.what;
    if (ab.distance < 1e-6) continue;  // two pushes may be equally short
    EXPECT_LT((ab.normal - ba.normal).norm(), 1e-9) << sample.what;
    EXPECT_LT((ab.point_a - ba.point_a).norm(), kNearlyParallel) << sample.what;
  }
}

TEST(BoxToBox, WitnessPointsOfParallelFacesAndEdgesMoveSmoothlyUnderSmallRotations) {
  const double angle = 1e-6;  // of a finite difference
  for (const Vector3d& p : {Vector3d(.4, .1, .5), Vector3d(.6, 0, 0), Vector3d(.8, .3, .6), Vector3d(.3, 0, .15)}) {
    const NearestPoints resting = toBoxAtOrigin(Matrix3d::Identity(), p, Vector3d(.2, .2, .1));
    for (int axis = 0; axis < 3; ++axis) {
      const NearestPoints turned = toBoxAtOrigin(axisRotation(axis, angle), p, Vector3d(.2, .2, .1));
      EXPECT_LT((turned.point_a - resting.point_a).norm(), 20. * angle) << p.transpose() << ", axis " << axis;
    }
  }
}

TEST(BoxToBox, DegenerateContactsGiveFiniteNumbers) {
  const std::vector<Vector3d> sizes = {{.1, .1, .1}, {.1, .1, 0.}, {.1, 0., 0.}, {0., 0., 0.}};
  const std::vector<Vector3d> places = {{0, 0, 0}, {.2, 0, 0}, {.2, .2, 0}, {.2, .2, .2}, {.1, .1, .1}, {1e-300, 0, 0}};
  for (const Vector3d& a : sizes) {
    for (const Vector3d& b : sizes) {
      for (const Vector3d& p : places) {
        for (const double angle : {0., 1e-15, 1e-9, std::atan(1.), 2. * std::atan(1.)}) {
          const NearestPoints near = boxToBox({{axisRotation(2, angle), p}, a}, {{}, b});
          EXPECT_TRUE(std::isfinite(near.distance) && near.point_a.allFinite() && near.point_b.allFinite());
          EXPECT_NEAR(near.normal.norm(), 1., kRounding);
        }
      }
    }
  }
}

TEST(BoxToBox, APoseThatIsNotFiniteReturns) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(std::isfinite(toBoxAtOrigin(Matrix3d::Identity(), Vector3d(nan, nan, nan), kHalf).distance));
}
