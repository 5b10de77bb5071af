#include "kinegraph/robot/safety_limits.h"

#include <gtest/gtest.h>

#include "kinegraph/trajectories/trajectory.h"
#include "tests/robot/arm.h"

using namespace kinegraph;

namespace {

RobotCommand to(const VectorXd& q, const VectorXd& velocity) { return {.01, q, velocity, pair(0., 0.), {}}; }

}  // namespace

TEST(SafetyLimits, LeavesAMotionWithinLimitsAsItIsToTheBit) {
  RobotInfo robot = plainRobot();
  MatrixXd points(2, 2);
  points << 0., 0., 1., -1.;
  const BSpline motion(3, points, pair(0., 1.));
  robot.velocity.setConstant(1.5);
  robot.acceleration.setConstant(6.);  // exactly what it needs
  VectorXd last = motion.eval(0.), last_velocity = motion.eval(0., 1);
  for (int tick = 1; tick <= 110; ++tick) {
    RobotCommand command = to(motion.eval(tick * .01), motion.eval(tick * .01, 1));
    const VectorXd q = command.q, velocity = command.velocity;
    limitCommand(command, last, last_velocity, robot);
    ASSERT_EQ(command.q, q) << tick;
    ASSERT_EQ(command.velocity, velocity) << tick;
    last = q;
    last_velocity = velocity;
  }
}

TEST(SafetyLimits, FollowsAJumpWithinLimitsAndComesToRestThere) {
  RobotInfo robot = plainRobot();
  robot.velocity.setConstant(1.);
  robot.acceleration.setConstant(5.);
  VectorXd q = pair(0., 0.), velocity = pair(0., 0.);
  double farthest = 0.;
  for (int tick = 0; tick < 200; ++tick) {
    RobotCommand command = to(pair(.6, -.3), pair(0., 0.));
    limitCommand(command, q, velocity, robot);
    EXPECT_LE((command.q - q).cwiseAbs().maxCoeff(), .01 * 1. + 1e-12);
    EXPECT_LE((command.velocity - velocity).cwiseAbs().maxCoeff(), .01 * 5. + 1e-9) << tick;
    q = command.q;
    velocity = command.velocity;
    farthest = std::max(farthest, q[0]);
  }
  EXPECT_NEAR(q[0], .6, 1e-6);
  EXPECT_NEAR(q[1], -.3, 1e-6);
  EXPECT_LT(farthest, .6 + .01);
}

TEST(SafetyLimits, StopsAtTheLimitsOfJoints) {
  RobotInfo robot = plainRobot();
  robot.upper[0] = .5;
  robot.velocity.setConstant(10.);
  VectorXd q = pair(.45, 0.), velocity = pair(0., 0.);
  for (int tick = 0; tick < 50; ++tick) {
    RobotCommand command = to(pair(.9, 0.), pair(0., 0.));
    limitCommand(command, q, velocity, robot);
    q = command.q;
    velocity = command.velocity;
  }
  EXPECT_NEAR(q[0], .5, 3e-3);
}
