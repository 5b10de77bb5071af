#include "kinegraph/ik/closed_form.h"

#include <gtest/gtest.h>

#include <numbers>

#include "kinegraph/common/random.h"

namespace kinegraph {
namespace {

constexpr double kPi = std::numbers::pi;

RigidTransform moved(const std::array<HingeAxis, 6>& axes, const SixAngles& angles) {
  RigidTransform X;
  for (std::size_t k = 0; k < 6; ++k) X = X * axes[k].turn(angles[k]);
  return X;
}

Vector3d randomVector(Rng& rng) { return {rng.uniform(-1., 1.), rng.uniform(-1., 1.), rng.uniform(-1., 1.)}; }

HingeAxis randomAxis(Rng& rng) { return {randomVector(rng).normalized(), randomVector(rng)}; }

/// Axes in general position, of which the last three meet in a point.
std::array<HingeAxis, 6> wristArm(Rng& rng) {
  std::array<HingeAxis, 6> axes;
  for (HingeAxis& axis : axes) axis = randomAxis(rng);
  axes[4].point = axes[3].point + .3 * axes[3].direction;
  axes[5].point = axes[4].point - .2 * axes[4].direction;
  axes[3].point = axes[5].point;
  axes[4].point = axes[5].point + .7 * axes[4].direction;
  return axes;
}

/// Axes 2 to 4 parallel, some against each other, and 5 and 6 intersect.
std::array<HingeAxis, 6> parallelArm(Rng& rng) {
  std::array<HingeAxis, 6> axes;
  for (HingeAxis& axis : axes) axis = randomAxis(rng);
  axes[2].direction = axes[1].direction, axes[3].direction = -axes[1].direction;
  axes[5].point = axes[4].point + .4 * axes[4].direction;
  return axes;
}

std::array<HingeAxis, 6> seenFromTheTool(const std::array<HingeAxis, 6>& axes) {
  std::array<HingeAxis, 6> other;
  for (std::size_t k = 0; k < 6; ++k) other[k] = axes[5 - k];
  return other;
}

/// All solutions reach the pose, they differ, and the angles that the pose came from are among them.
void expectAllSolutions(const std::array<HingeAxis, 6>& axes, Rng& rng, int most) {
  const ClosedFormArm arm(axes);
  ASSERT_TRUE(arm.isSolvable());
  SixAngles angles;
  for (double& angle : angles) angle = rng.uniform(-kPi, kPi);
  const RigidTransform X = moved(axes, angles);
  bool found = false;
  const std::vector<SixAngles> all = arm.solve(X);
  for (const SixAngles& solution : all) {
    const RigidTransform reached = moved(axes, solution);
    EXPECT_LT((reached.R - X.R).norm() + (reached.p - X.p).norm(), 1e-6);
    double difference = 0.;
    for (std::size_t k = 0; k < 6; ++k)
      difference = std::max(difference, std::abs(std::remainder(solution[k] - angles[k], 2. * kPi)));
    found = found || difference < 1e-5;
  }
  EXPECT_TRUE(found) << all.size();
  EXPECT_LE(int(all.size()), most);
  EXPECT_EQ(all.size() % 2, 0u);
}

TEST(ClosedForm, ASphericalWristInGeneralPositionHasAllItsSolutions) {
  Rng rng(1);
  for (int trial = 0; trial < 200; ++trial) expectAllSolutions(wristArm(rng), rng, 8);
}

TEST(ClosedForm, ThreeParallelAxesHaveAllTheirSolutions) {
  Rng rng(2);
  for (int trial = 0; trial < 200; ++trial) expectAllSolutions(parallelArm(rng), rng, 8);
}

TEST(ClosedForm, BothKindsAreSolvedFromTheOtherEndToo) {
  Rng rng(3);
  for (int trial = 0; trial < 100; ++trial) {
    expectAllSolutions(seenFromTheTool(wristArm(rng)), rng, 8);
    expectAllSolutions(seenFromTheTool(parallelArm(rng)), rng, 8);
  }
}

TEST(ClosedForm, ArmsWithParallelAndIntersectingAxesBeforeTheWristAreSolved) {
  Rng rng(4);
  for (int trial = 0; trial < 100; ++trial) {
    std::array<HingeAxis, 6> elbow = wristArm(rng);  // axes 2 and 3 parallel, as of most industrial arms
    elbow[2].direction = elbow[1].direction;
    expectAllSolutions(elbow, rng, 8);
    std::array<HingeAxis, 6> shoulder = wristArm(rng);
    shoulder[1].point = shoulder[0].point;
    expectAllSolutions(shoulder, rng, 8);
    std::array<HingeAxis, 6> both = elbow;  // an anthropomorphic arm
    both[1].point = both[0].point;
    expectAllSolutions(both, rng, 8);
    std::array<HingeAxis, 6> scara = wristArm(rng);
    scara[1].direction = scara[0].direction;
    expectAllSolutions(scara, rng, 8);
  }
}

TEST(ClosedForm, APoseBeyondReachHasNoSolutionAndGeneralArmsHaveNoClosedForm) {
  Rng rng(5);
  RigidTransform far;
  far.p = Vector3d(30., 0., 0.);
  EXPECT_TRUE(ClosedFormArm(wristArm(rng)).solve(far).empty());
  EXPECT_TRUE(ClosedFormArm(parallelArm(rng)).solve(far).empty());
  std::array<HingeAxis, 6> general;
  for (HingeAxis& axis : general) axis = randomAxis(rng);
  EXPECT_FALSE(ClosedFormArm(general).isSolvable());
}

}  // namespace
}  // namespace kinegraph
