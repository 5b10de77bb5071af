#include "kinegraph/scene/dynamics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/scene/config.h"
#include "tests/support/scene.h"

using namespace kinegraph;

TEST(MotorLimits, AreTheFirstTwoNumbersOfEachJointInTheOrderOfQ) {
  const Config config = scene(
      "a: {} j (a): { joint: hingeX, ctrl_limits: [2 30 -1] } k (j): { joint: transZ } l (k): { joint: hingeY, "
      "ctrl_limits: "
      "[.5 -1 9] }");
  const VectorXd velocity = getVelocityLimits(config), effort = getEffortLimits(config);
  ASSERT_EQ(velocity.size(), 3);
  EXPECT_EQ(velocity[0], 2.);
  EXPECT_TRUE(std::isinf(velocity[1]));
  EXPECT_EQ(velocity[2], .5);
  EXPECT_EQ(effort[0], 30.);
  EXPECT_TRUE(std::isinf(effort[1]) && std::isinf(effort[2])) << "-1 says nothing";
}

TEST(MotorLimits, AreThoseOfQWhereTheMotionIsScaled) {
  const Config config = scene("a: {} j (a): { joint: hingeX, joint_scale: -2, ctrl_limits: [4 10 -1] }");
  EXPECT_EQ(getVelocityLimits(config)[0], 2.);  // q at 2 rad/s turns at 4 rad/s
  EXPECT_EQ(getEffortLimits(config)[0], 20.);   // the work of both is the same
}

TEST(MotorLimits, OfADofAreTheTightestOfAllThatFollowIt) {
  const Config config = scene(
      "a: {} j (a): { joint: hingeX, ctrl_limits: [4 10 -1] } m (a): { joint: hingeX, mimic: j, joint_scale: 4, "
      "ctrl_limits: "
      "[4 1 -1] }");
  EXPECT_EQ(getVelocityLimits(config)[0], 1.);
  EXPECT_EQ(getEffortLimits(config)[0], 10.) << "each motor drives its own joint";
}

TEST(MotorLimits, OfQuaternionsAndOfJointsOutsideQAreNone) {
  Config config =
      scene("a: {} j (a): { joint: quatBall, ctrl_limits: [4 10 -1] } k (a): { joint: hingeX, ctrl_limits: [1 2 3] }");
  EXPECT_TRUE(std::isinf(getVelocityLimits(config).head(4).minCoeff()));
  EXPECT_EQ(getVelocityLimits(config)[4], 1.);
  config.selectJoints({"j"});
  EXPECT_EQ(getVelocityLimits(config).size(), 4);
}
