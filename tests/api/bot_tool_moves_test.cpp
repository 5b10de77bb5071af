#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kinegraph/robot/bot_op.h"
#include "kinegraph/robot/drivers.h"
#include "kinegraph/tool_paths/plan_tool_path.h"
#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

/// Three hinges in the plane with limits of speed; the tool is 1.1 m from the base at most.
Config weldingArm(const std::string& more = {}) {
  Config C;
  C.addText(std::string(R"(
base: {}
j1 (base): { joint: hingeZ, limits: [-3 3], ctrl_limits: [2 50 -1] }
l1 (j1): { shape: capsule, size: [.3 .03], Q: [.25 0 0 .7071068 0 .7071068 0], contact: 1 }
j2 (j1): { joint: hingeZ, pre: [.5 0 0], limits: [-3 3], ctrl_limits: [2 50 -1] }
j3 (j2): { joint: hingeZ, pre: [.5 0 0], limits: [-3 3], ctrl_limits: [2 50 -1] }
torch (j3): { shape: sphere, size: [.01], Q: [.1 0 0], contact: -1 }
)") + more);
  C.setJointState(Vector3d(.3, .8, -1.1));
  return C;
}

struct WeldingCell {
  explicit WeldingCell(const std::string& more = {})
      : C(weldingArm(more)), bot(C, std::make_shared<KinematicDriver>(C)) {}

  Config C;
  BotOp bot;

  Vector3d torch() { return C.getFrame("torch").getPosition(); }

  /// Advances by one period; false at the end of the motion.
  bool step() {
    bot.sync(C, .01);
    return bot.getTimeToEnd() > 0.;
  }
};

TEST(BotToolMoves, ALinearMoveIsStraightFromWhereTheRobotIs) {
  WeldingCell cell;
  const Vector3d begin = cell.torch(), way(-.3, -.1, 0.);
  const ToolPathPlan plan = cell.bot.moveLinear("torch", Vector3d(begin + way), {.speed = .2});
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_LE(plan.position_deviation, 2e-5);
  EXPECT_EQ(plan.segments.size(), 1u);
  while (cell.step()) {
    const Vector3d moved = cell.torch() - begin;
    EXPECT_LE(moved.cross(way.normalized()).norm(), plan.position_deviation + 1e-9);
  }
  EXPECT_LT((cell.torch() - begin - way).norm(), 2e-5);
}

TEST(BotToolMoves, ACircularMoveStaysOnItsCircle) {
  WeldingCell cell;
  const Vector3d begin = cell.torch(), center = begin - Vector3d(.1, 0., 0.);
  const ToolPathPlan plan = cell.bot.moveCircular("torch", center + Vector3d(0., .1, 0.),
                                                  Vector3d(center - Vector3d(.1, 0., 0.)), {.speed = .2});
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_NEAR(plan.way(plan.duration()).place, .1 * std::numbers::pi, 1e-6);
  while (cell.step()) EXPECT_NEAR((cell.torch() - center).norm(), .1, 2.1e-5);
}

TEST(BotToolMoves, MovesThatAreAppendedBeginWhereTheOneBeforeEnds) {
  WeldingCell cell;
  const Vector3d begin = cell.torch(), corner = begin + Vector3d(-.2, 0., 0.), end = corner + Vector3d(0., -.2, 0.);
  ASSERT_TRUE(cell.bot.moveLinear("torch", corner, {.speed = .2}).feasible());
  cell.step();  // the robot moves
  ASSERT_TRUE(cell.bot.moveLinear("torch", end, {.speed = .2}).feasible());
  double nearest = 1.;
  while (cell.step()) {
    const Vector3d p = cell.torch();
    EXPECT_TRUE(std::abs(p[1] - corner[1]) < 3e-5 || std::abs(p[0] - corner[0]) < 3e-5) << p.transpose();
    nearest = std::min(nearest, (p - corner).norm());
  }
  EXPECT_LT(nearest, 2e-4);
  EXPECT_LT((cell.torch() - end).norm(), 2e-5);
}

TEST(BotToolMoves, OverwriteBrakesAndMovesOnFromThere) {
  WeldingCell cell;
  const Vector3d begin = cell.torch(), end = begin + Vector3d(-.1, -.3, 0.);
  cell.bot.moveTo(Vector3d(-.5, 1.2, -.4));
  for (int k = 0; k < 50; ++k) cell.step();
  ASSERT_GT(cell.bot.get_qDot().cwiseAbs().maxCoeff(), .1);
  const ToolPathPlan plan = cell.bot.moveLinear("torch", end, {.speed = .2}, true);
  ASSERT_TRUE(plan.feasible()) << plan.message;
  cell.C.setJointState(plan.eval(0.).q);
  const Vector3d rest = cell.torch(), along = (end - rest).normalized();
  EXPECT_GT((rest - begin).cross(along).norm(), .01);
  bool on_line = false;
  VectorXd before = cell.bot.stepObservation().qvel;
  while (cell.step()) {
    const VectorXd velocity = cell.bot.stepObservation().qvel;
    EXPECT_LT((velocity - before).cwiseAbs().maxCoeff(), .5);  // no jump: the brakes take .05 s
    before = velocity;
    const Vector3d moved = cell.torch() - rest;
    on_line = on_line || moved.dot(along) > 0.;
    if (on_line) EXPECT_LT(moved.cross(along).norm(), 2.1e-5);
  }
  EXPECT_LT((cell.torch() - end).norm(), 2e-5);
}

TEST(BotToolMoves, ASequenceBlendsItsCornersWithinTheRadius) {
  WeldingCell cell;
  const Vector3d begin = cell.torch(), corner = begin + Vector3d(-.2, 0., 0.), end = corner + Vector3d(0., -.2, 0.);
  const ToolPathPlan plan = cell.bot.moveSequence("torch", {corner, end}, .05, {.speed = .1});
  ASSERT_TRUE(plan.feasible()) << plan.message;
  double nearest = 1., slowest = 1.;
  while (cell.step()) {
    const Vector3d p = cell.torch();
    const double distance = (p - corner).norm();
    nearest = std::min(nearest, distance);
    if (distance > .05) EXPECT_TRUE(std::abs(p[1] - corner[1]) < 3e-5 || std::abs(p[0] - corner[0]) < 3e-5);
  }
  for (double t = .3; t < plan.duration() - .3; t += .01) slowest = std::min(slowest, plan.speed(t));
  EXPECT_GT(nearest, .001);
  EXPECT_LT(nearest, .05);
  EXPECT_GT(slowest, .099);  // it does not stop at the corner
}

TEST(BotToolMoves, APathWithAStartIsReachedByATransfer) {
  WeldingCell cell;
  const Vector3d first(.6, -.2, 0.), last(.6, .2, 0.);
  const ToolPathPlan plan = cell.bot.moveSequence(ToolPath("torch").start(first).line(last).free(), {.speed = .2});
  ASSERT_TRUE(plan.feasible()) << plan.message;
  ASSERT_EQ(plan.segments.size(), 2u);
  EXPECT_EQ(plan.segments[0].kind, ToolSegment::Kind::transfer);
  while (cell.step()) continue;
  EXPECT_LT((cell.torch() - last).norm(), 2e-5);
}

TEST(BotToolMoves, WhatCannotBeDoneIsAPlanWithPlaceAndTheRobotStays) {
  WeldingCell cell;
  const VectorXd q = cell.bot.get_q();
  const ToolPathPlan far = cell.bot.moveLinear("torch", Vector3d(2., 0., 0.), {.speed = .2});
  EXPECT_FALSE(far.feasible());
  EXPECT_GT(far.where.place, .01);
  cell.step();
  EXPECT_EQ((cell.bot.get_q() - q).norm(), 0.);
  expectError<FrameNotFound>([&] { cell.bot.moveLinear("torhc", Vector3d(.5, 0., 0.), {}); }, {"torhc", "torch"});
  expectError<ValueError>([&] { cell.bot.moveSequence("torch", {}, .01, {}); }, {"moveSequence", "at least one"});
  expectError<ValueError>([&] { cell.bot.moveLinear("torch", Vector3d(.5, 0., 0.), {.speed = -1.}); }, {"speed"});
}

TEST(BotToolMoves, ObstaclesOfTheWorldEndAMoveAndAreNamed) {
  WeldingCell cell("post: { X: [.75 .3 0], shape: cylinder, size: [.3 .02], contact: 1 }");
  cell.C.setJointState(Vector3d(.3, .8, -1.1));
  const ToolPathPlan plan = cell.bot.moveSequence(ToolPath("torch").line(Vector3d(.75, .3, 0.)).free(), {.speed = .2});
  EXPECT_EQ(plan.status, ToolPathStatus::in_collision) << plan.message;
  ASSERT_EQ(plan.frames.size(), 2u);
  EXPECT_TRUE(plan.frames[0] == "post" || plan.frames[1] == "post");
}

TEST(BotToolMoves, TheLimitsOfTheRobotCount) {
  WeldingCell cell;
  cell.bot.setLimits(VectorXd::Constant(1, .1), VectorXd::Constant(1, .5), {});
  const ToolPathPlan plan =
      cell.bot.moveLinear("torch", Vector3d(cell.torch() + Vector3d(-.3, -.1, 0.)), {.speed = 1.});
  ASSERT_TRUE(plan.feasible()) << plan.message;
  double fastest = 0.;
  while (cell.step()) fastest = std::max(fastest, cell.bot.stepObservation().qvel.cwiseAbs().maxCoeff());
  EXPECT_LE(fastest, .1 * (1. + 1e-6));
  EXPECT_GT(fastest, .095);
  ASSERT_FALSE(plan.slow.empty());
}

TEST(BotToolMoves, ARobotWithoutAWorldMovesByItsScene) {
  Config C = weldingArm();
  RobotInfo info = RobotInfo::of(C, "real");
  BotOp bot(C, std::make_shared<RecordedDriver>(info, std::vector<RobotState>{}, C.getJointState()));
  const Vector3d begin = C.getFrame("torch").getPosition();
  const ToolPathPlan plan = bot.moveLinear("torch", Vector3d(begin + Vector3d(-.1, 0., 0.)), {.speed = .2});
  ASSERT_TRUE(plan.feasible()) << plan.message;
  bot.wait(C, false);
  EXPECT_LT((C.getFrame("torch").getPosition() - begin - Vector3d(-.1, 0., 0.)).norm(), 2e-5);
}

}  // namespace
}  // namespace kinegraph
