#include "kinegraph/planning/plan_among_obstacles.h"

#include "tests/planning/dynamic_room.h"
#include "tests/planning/plane_room.h"

namespace kinegraph {
namespace {

constexpr double kFine = 5e-4;  // s

PlanOptions among(const std::vector<ObstacleTrajectory>& obstacles) {
  PlanOptions options{.margin = .01};
  options.velocity = VectorXd::Constant(1, 1.);
  options.acceleration = VectorXd::Constant(1, 4.);
  options.obstacle_trajectories = obstacles;
  return options;
}

const VectorXd kAcross{{1., 0.}};

TEST(PlanAmongObstacles, WhatPassesElsewhereCostsNoTime) {
  const std::vector<ObstacleTrajectory> cart = {moves("cart", {{0., poseAt(-1., 1.5)}, {3., poseAt(1., 1.5)}})};
  const MotionPlan plan = planMotion(discAndBox(), kAcross, among(cart));
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_NEAR(plan.duration(), 2.25, 1e-9);
  EXPECT_EQ(plan.stages.back().name, "dynamic_timing");
}

TEST(PlanAmongObstacles, ItKeepsClearOfWhatCrossesItsWay) {
  const std::vector<ObstacleTrajectory> cart = {moves("cart", {{0., poseAt(0., -1.5)}, {3., poseAt(0., 1.5)}})};
  const MotionPlan plan = planMotion(discAndBox(), kAcross, among(cart));
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_GE(leastOfTime(discAndBox(), plan, cart, kFine), .01 - 1e-9);
  expectSmooth(plan, 1., 4.);
  EXPECT_LT(plan.duration(), 3.5);
  EXPECT_TRUE(plan.obstaclesAt(1.5).front().isApprox(poseAt(0., 0.)));
}

TEST(PlanAmongObstacles, ItWaitsBeforeADoorUntilWhatStandsInItHasLeft) {
  Config C = room(.6);
  C.addText("cart: {}\nbox(cart): {shape: ssBox, size: [0.4, 0.4, 0.2, 0.01], contact: 1}");
  C.setJointState(VectorXd{{-1., 0.}});
  // It stands in the door, and at 4 s leaves it on the other side.
  const std::vector<ObstacleTrajectory> cart = {
      moves("cart", {{4., poseAt(0., 0.)}, {4.8, poseAt(.8, 0.)}, {6., poseAt(.8, 1.5)}})};
  const MotionPlan plan = planMotion(C, VectorXd{{1.4, 0.}}, among(cart));
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_GT(plan.duration(), 4.5);
  EXPECT_LT(plan.duration(), 8.);
  EXPECT_GE(leastOfTime(C, plan, cart, kFine), .01 - 1e-9);
  expectSmooth(plan, 1., 4.);
}

TEST(PlanAmongObstacles, LimitsOfTheJerkHoldWhileItWaits) {
  const std::vector<ObstacleTrajectory> cart = {moves("cart", {{0., poseAt(0., -1.)}, {8., poseAt(0., 1.)}})};
  PlanOptions options = among(cart);
  options.jerk = VectorXd::Constant(1, 20.);
  Config C = room(3.);  // the wall is so wide that no path leads around the cart
  C.addText("cart: {}\nbox(cart): {shape: ssBox, size: [0.4, 2.0, 0.2, 0.01], contact: 1}");
  C.setJointState(VectorXd{{-1., 0.}});
  const MotionPlan plan = planMotion(C, kAcross, options);
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_GE(leastOfTime(C, plan, cart, kFine), .01 - 1e-9);
  MotionState before = plan.eval(0.);
  for (double t = 1e-3; t <= plan.duration(); t += 1e-3) {
    const MotionState now = plan.eval(t);
    ASSERT_LE((now.acceleration - before.acceleration).cwiseAbs().maxCoeff(), 20. * 1e-3 * (1. + 1e-6) + 1e-9) << t;
    before = now;
  }
}

TEST(PlanAmongObstacles, AJointOfTheSceneMovesAsItIsTold) {
  Config C = discAndBox();
  C.addText("hub: {}\narm(hub): {joint: hingeZ}\nbar(arm): {shape: ssBox, size: [2.4, 0.1, 0.2, 0.01], contact: 1}");
  C.delFrame("cart");
  C.delFrame("box");
  C.selectJoints({"disc"});
  const std::vector<ObstacleTrajectory> bar = {moves("arm", {{0., VectorXd{{1.2}}}, {6., VectorXd{{7.}}}})};
  const MotionPlan plan = planMotion(C, kAcross, among(bar));
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_GE(leastOfTime(C, plan, bar, kFine), .01 - 1e-9);
}

TEST(PlanAmongObstacles, WhatStaysAtTheGoalIsNamed) {
  const std::vector<ObstacleTrajectory> cart = {moves("cart", {{0., poseAt(1., -1.5)}, {2., poseAt(1., .1)}})};
  const MotionPlan plan = planMotion(discAndBox(), kAcross, among(cart));
  EXPECT_EQ(plan.status, PlanStatus::no_timing_found);
  EXPECT_NE(plan.message.find("at the goal, 'body' meets 'box', which stays there"), std::string::npos) << plan.message;
  EXPECT_THROW(plan.eval(0.), ValueError);
}

TEST(PlanAmongObstacles, WhatComesToTheGoalLaterIsNamed) {
  // The robot is about to arrive, and cannot avoid an obstacle that passes by soon after that.
  for (int k = 0; k < 12; ++k) {
    PlanOptions options = among({moves("cart", {{.1, poseAt(1., -1.9)}, {.7 + .01 * k, poseAt(1., 1.9)}})});
    options.start_velocity = VectorXd{{.6, 0.}};
    const MotionPlan plan = planMotion(discAndBox(), kAcross, options, VectorXd{{.95, 0.}});
    EXPECT_EQ(plan.status, PlanStatus::no_timing_found);
    EXPECT_NE(plan.message.find("'body' meets 'box'"), std::string::npos) << k << plan.message;
  }
}

TEST(PlanAmongObstacles, ItGoesOutOfTheWayOfWhatComesToTheStart) {
  const std::vector<ObstacleTrajectory> cart = {moves("cart", {{0., poseAt(-1., -1.8)}, {3.6, poseAt(-1., 1.8)}})};
  const MotionPlan plan = planMotion(discAndBox(), kAcross, among(cart));
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_GE(leastOfTime(discAndBox(), plan, cart, kFine), .01 - 1e-9);
}

TEST(PlanAmongObstacles, ItStepsAsideOfWhatComesAlongItsWay) {
  Config C = room(.6);
  C.addText("cart: {}\nbox(cart): {shape: ssBox, size: [0.5, 0.5, 0.2, 0.01], contact: 1}");
  C.setJointState(VectorXd{{-1., 0.}});
  // It comes through the door, over the start, and away; before the door there is room at both sides.
  const std::vector<ObstacleTrajectory> cart = {moves("cart", {{0., poseAt(1.8, 0.)}, {6., poseAt(-2.4, 0.)}})};
  const MotionPlan plan = planMotion(C, VectorXd{{1.2, 0.}}, among(cart));
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_GE(leastOfTime(C, plan, cart, kFine), .01 - 1e-9);
  expectSmooth(plan, 1., 4.);
}

TEST(PlanAmongObstacles, ThreadsChangeNothing) {
  const std::vector<ObstacleTrajectory> cart = {moves("cart", {{0., poseAt(0., -1.5)}, {3., poseAt(0., 1.5)}})};
  PlanOptions options = among(cart);
  const MotionPlan one = planMotion(discAndBox(), kAcross, options);
  options.threads = 3;
  const MotionPlan three = planMotion(discAndBox(), kAcross, options);
  EXPECT_EQ(one.path, three.path);
  EXPECT_EQ(one.times(), three.times());
}

}  // namespace
}  // namespace kinegraph
