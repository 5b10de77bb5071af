#include "kinegraph/geometry/distance/closed_form/cylinder_distance.h"

#include <gtest/gtest.h>

#include "tests/support/geometry_samples.h"

using namespace kinegraph;
using namespace kinegraph::testing;

namespace {

constexpr double kCylinderRounding = 1e-12;
const CylinderCore kCylinder{{}, .3, .5};

void expectNear(const Vector3d& point, double distance, const Vector3d& normal) {
  const NearestPoints near = pointToCylinder(point, kCylinder);
  EXPECT_NEAR(near.distance, distance, kCylinderRounding) << point.transpose();
  EXPECT_LT((near.normal - normal).norm(), kCylinderRounding) << point.transpose();
  EXPECT_LT((near.point_a - near.point_b - distance * normal).norm(), kCylinderRounding) << point.transpose();
}

}  // namespace

TEST(PointToCylinder, OutsideTheSideTheCapOrTheRimIsNearest) {
  expectNear(Vector3d(0, .8, .2), .5, Vector3d::UnitY());
  expectNear(Vector3d(.1, .1, -.9), .4, -Vector3d::UnitZ());
  expectNear(Vector3d(.6, 0, .9), .5, Vector3d(.6, 0, .8));
}

TEST(PointToCylinder, InsideTheNearerOfSideAndCapIsThePush) {
  expectNear(Vector3d(.2, 0, .1), -.1, Vector3d::UnitX());
  expectNear(Vector3d(.1, 0, .45), -.05, Vector3d::UnitZ());
  expectNear(Vector3d(0, 0, -.45), -.05, -Vector3d::UnitZ());
}

TEST(PointToCylinder, OnTheSurfaceAndOnTheAxisTheNormalIsAUnitVector) {
  expectNear(Vector3d(0, 0, .5), 0., Vector3d::UnitZ());
  expectNear(Vector3d(.3, 0, 0), 0., Vector3d::UnitX());
  EXPECT_NEAR(pointToCylinder(Vector3d(0, 0, 0), kCylinder).distance, -.3, kCylinderRounding);
  EXPECT_NEAR(pointToCylinder(Vector3d(0, 0, 0), kCylinder).normal.norm(), 1., kCylinderRounding);
}

TEST(PointToCylinder, MovesWithTheCylinder) {
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const Vector3d point = randomVector(rng, .6);
    const RigidTransform X = randomTransform(rng);
    const NearestPoints resting = pointToCylinder(point, kCylinder);
    const NearestPoints moved = pointToCylinder(X * point, {X, kCylinder.radius, kCylinder.half_length});
    EXPECT_NEAR(moved.distance, resting.distance, kCylinderRounding);
    EXPECT_LT((moved.normal - X.R * resting.normal).norm(), 1e-9);
    EXPECT_LT((moved.point_b - X * resting.point_b).norm(), 1e-9);
  }
}
