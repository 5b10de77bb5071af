#include "kinegraph/geometry/distance/closed_form/box_distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/geometry/distance/closed_form/box_box_distance.h"
#include "tests/support/box_samples.h"

using namespace kinegraph;
using namespace kinegraph::testing;

namespace {

const BoxCore kBox{{}, Vector3d(.3, .2, .1)};

NearestPoints vertical(double x, double y, double z, double half) {
  return segmentToBox({Vector3d(x, y, z), Vector3d::UnitZ(), half}, kBox);
}

}  // namespace

TEST(PointToBox, OutsideTheNearestPointIsTheClampedOne) {
  const NearestPoints near = pointToBox(Vector3d(.6, .6, .1), kBox);
  EXPECT_NEAR(near.distance, .5, kRounding);
  EXPECT_LT((near.point_b - Vector3d(.3, .2, .1)).norm(), kRounding);
  EXPECT_LT((near.normal - Vector3d(.6, .8, 0)).norm(), kRounding);
}

TEST(PointToBox, InsideTheNearestPointIsOnTheNearestFace) {
  const NearestPoints near = pointToBox(Vector3d(.1, -.15, .02), kBox);
  EXPECT_NEAR(near.distance, -.05, kRounding);
  EXPECT_LT((near.point_b - Vector3d(.1, -.2, .02)).norm(), kRounding);
  EXPECT_LT((near.normal + Vector3d::UnitY()).norm(), kRounding);
}

TEST(PointToBox, OnAFaceTheNormalIsThatOfTheFace) {
  const NearestPoints near = pointToBox(Vector3d(.1, .1, -.1), kBox);
  EXPECT_NEAR(near.distance, 0., kRounding);
  EXPECT_LT((near.normal + Vector3d::UnitZ()).norm(), kRounding);
}

TEST(PointToBox, IsBoxToBoxForABoxWithoutExtent) {
  for (const BoxPairSample& sample : boxPairs(400, 1)) {
    const NearestPoints near = pointToBox(sample.a.X_WB.p, sample.b);
    const NearestPoints general = boxToBox({sample.a.X_WB, Vector3d::Zero()}, sample.b);
    EXPECT_NEAR(near.distance, general.distance, kRounding) << sample.what;
  }
}

TEST(SegmentToBox, BesideTheBoxTheWitnessIsTheMiddleOfTheSharedStretch) {
  const NearestPoints near = vertical(.5, .1, .15, .1);  // shares z from .05 to .1
  EXPECT_NEAR(near.distance, .2, kRounding);
  EXPECT_LT((near.point_a - Vector3d(.5, .1, .075)).norm(), kRounding);
  EXPECT_LT((near.point_b - Vector3d(.3, .1, .075)).norm(), kRounding);
  EXPECT_LT((near.normal - Vector3d::UnitX()).norm(), kRounding);
}

TEST(SegmentToBox, AboveTheBoxTheLowerEndIsNearest) {
  const NearestPoints near = vertical(0., 0., .5, .1);
  EXPECT_NEAR(near.distance, .3, kRounding);
  EXPECT_LT((near.point_a - Vector3d(0, 0, .4)).norm(), kRounding);
}

TEST(SegmentToBox, PassingAnEdgeAtRightAnglesThePointsAreOnTheEdgeAndInTheSegment) {
  const Vector3d axis = Vector3d(1, -1, 0).normalized();
  const NearestPoints near = segmentToBox({Vector3d(.4, .3, 0), axis, 1.}, kBox);
  EXPECT_NEAR(near.distance, .1 * std::sqrt(2.), kRounding);
  EXPECT_LT((near.normal - Vector3d(1, 1, 0).normalized()).norm(), kRounding);
  EXPECT_LT((near.point_a - Vector3d(.4, .3, 0)).norm(), kRounding);
}

TEST(SegmentToBox, StickingInAFaceTheDepthIsThatOfTheEnd) {
  const NearestPoints near = vertical(.1, .05, .15, .1);
  EXPECT_NEAR(near.distance, -.05, kRounding);
  EXPECT_LT((near.point_a - Vector3d(.1, .05, .05)).norm(), kRounding);
  EXPECT_LT((near.point_b - Vector3d(.1, .05, .1)).norm(), kRounding);
}

TEST(SegmentToBox, CuttingAnEdgeThePushIsAcrossTheEdge) {
  const Vector3d axis = Vector3d(1, -1, 0).normalized();
  const NearestPoints near = segmentToBox({Vector3d(.29, .19, 0), axis, 1.}, kBox);
  EXPECT_NEAR(near.distance, -.01 * std::sqrt(2.), kRounding);
  EXPECT_LT((near.normal - Vector3d(1, 1, 0).normalized()).norm(), kRounding);
}

TEST(SegmentToBox, NearestPointsLieOnBothAndAPlaneBetweenThemProvesTheDistance) {
  for (const BoxPairSample& sample : boxPairs(1500, 2)) {
    const SegmentCore segment{sample.a.X_WB.p, sample.a.X_WB.R.col(2), sample.a.half.z()};
    const NearestPoints near = segmentToBox(segment, sample.b);
    if (near.distance <= 0.) continue;
    const double lowest = near.normal.dot(segment.center) - segment.half * std::abs(near.normal.dot(segment.axis));
    EXPECT_NEAR(lowest, near.distance + supportOf(sample.b, near.normal), kRounding) << sample.what;
    EXPECT_LT(distanceOutside(sample.b, near.point_b), kNearlyParallel) << sample.what;
    const double s = segment.axis.dot(near.point_a - segment.center);
    EXPECT_LT((segment.at(s) - near.point_a).norm(), kRounding) << sample.what;
    EXPECT_LE(std::abs(s), segment.half + kRounding) << sample.what;
  }
}

TEST(SegmentToBox, IsBoxToBoxForABoxOfOneDimension) {
  int apart = 0, overlapping = 0;
  for (const BoxPairSample& sample : boxPairs(1500, 3)) {
    const Vector3d thin(0., 0., sample.a.half.z());
    const NearestPoints near = segmentToBox({sample.a.X_WB.p, sample.a.X_WB.R.col(2), thin.z()}, sample.b);
    const NearestPoints general = boxToBox({sample.a.X_WB, thin}, sample.b);
    EXPECT_NEAR(near.distance, general.distance, near.distance > 0. ? kRounding : kIllConditioned) << sample.what;
    ++(near.distance > 0. ? apart : overlapping);
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(overlapping, 100);
}

TEST(SegmentToBox, ASegmentWithoutLengthIsAPoint) {
  for (const BoxPairSample& sample : boxPairs(400, 4)) {
    const NearestPoints point = pointToBox(sample.a.X_WB.p, sample.b);
    const NearestPoints near = segmentToBox({sample.a.X_WB.p, sample.a.X_WB.R.col(2), 0.}, sample.b);
    EXPECT_NEAR(near.distance, point.distance, kRounding) << sample.what;
  }
}
