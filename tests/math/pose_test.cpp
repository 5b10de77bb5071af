#include "kinegraph/math/pose.h"

#include <gtest/gtest.h>

#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"

using namespace kinegraph;

namespace {
Pose randomPose(Rng& rng) {
  VectorXd numbers(7);
  for (double& x : numbers) x = rng.normal();
  return Pose::fromNumbers(numbers);
}
}  // namespace

TEST(Pose, TimesItsInverseIsTheIdentity) {
  Rng rng(1);
  for (int i = 0; i < 100; ++i) {
    const Pose X = randomPose(rng);
    EXPECT_TRUE((X * X.inverse()).isIdentity(1e-14));
  }
}

TEST(Pose, AgreesWithTheRotationMatrixForm) {
  Rng rng(2);
  for (int i = 0; i < 100; ++i) {
    const Pose A = randomPose(rng), B = randomPose(rng);
    const RigidTransform AB = A.transform() * B.transform();
    EXPECT_LT(((A * B).transform().R - AB.R).norm(), 1e-14);
    EXPECT_LT(((A * B).p - AB.p).norm(), 1e-14);
  }
}

TEST(Pose, FromNumbersNormalizesAndRejectsZero) {
  EXPECT_NEAR(Pose::fromNumbers((VectorXd(4) << 2, 0, 0, 0).finished()).q.w(), 1., 1e-15);
  EXPECT_THROW(Pose::fromNumbers(VectorXd::Zero(7)), ValueError);
  EXPECT_THROW(Pose::fromNumbers(VectorXd::Zero(5)), ValueError);
}

TEST(AxisRotation, TurnsTheNextAxisTowardsTheOneAfterIt) {
  const Matrix3d R = axisRotation(2, std::numbers::pi / 2);
  EXPECT_LT((R * Vector3d::UnitX() - Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT((skew({1, 2, 3}) * Vector3d(4, 5, 6) - Vector3d(1, 2, 3).cross(Vector3d(4, 5, 6))).norm(), 1e-15);
}
