#include "kinegraph/math/pose.h"

#include <gtest/gtest.h>

namespace kinegraph {
namespace {

TEST(LookAt, ZPointsAtTheTargetAndYDownwards) {
  const Vector3d position(1., 2., 3.), target(4., -2., 1.);
  const Pose camera = lookAt(position, target);
  EXPECT_EQ(camera.p, position);
  EXPECT_NEAR((camera.q * Vector3d::UnitZ() - (target - position).normalized()).norm(), 0., 1e-12);
  EXPECT_LT((camera.q * Vector3d::UnitY()).z(), 0.);
  EXPECT_NEAR((camera.q * Vector3d::UnitX()).z(), 0., 1e-12);  // upright
}

TEST(LookAt, StraightDownIsARotationAsWell) {
  const Pose camera = lookAt({0., 0., 2.}, {0., 0., 0.});
  EXPECT_NEAR(camera.q.norm(), 1., 1e-12);
  EXPECT_NEAR((camera.q * Vector3d::UnitZ() + Vector3d::UnitZ()).norm(), 0., 1e-9);
}

}  // namespace
}  // namespace kinegraph
