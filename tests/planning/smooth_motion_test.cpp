#include "kinegraph/planning/smooth_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/planning/plan_motion.h"
#include "kinegraph/planning/plan_timing.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

/// A disc in the plane, and a row of posts that it winds around.
Config posts() {
  Config C;
  C.addFrame("floor");
  C.addFrame("disc", "floor").setJoint(JointType::transXY, {-3., -2., 3., 2.});
  C.addFrame("body", "disc").setShape(ShapeType::cylinder, {.2, .1}).setContact(1);
  for (const auto& [x, low, high] : {std::array{-1., -2.5, .3}, {0., -.3, 2.5}, {1., -2.5, .3}}) {
    Frame wall = C.addFrame("wall " + std::to_string(x));
    wall.setShape(ShapeType::box, {.1, high - low, .5}).setContact(1).setPosition({x, .5 * (low + high), 0.});
  }
  C.setJointState(VectorXd{{-2., -.5}});
  return C;
}

const VectorXd kGoal{{2., -.5}};

PlanOptions options(int slices, int threads = 1) {
  return {
      .margin = .02, .slices = slices, .threads = threads, .velocity = VectorXd{{1.}}, .acceleration = VectorXd{{2.}}};
}

}  // namespace

TEST(SmoothMotion, IsFasterThanCornersAndKeepsMarginLimitsAndEnds) {
  Config C = posts();
  const MotionPlan cornered = planMotion(C, kGoal, options(0)), bent = planMotion(C, kGoal, options(80));
  ASSERT_TRUE(cornered.feasible() && bent.feasible()) << bent.message;
  EXPECT_LT(bent.duration(), .97 * cornered.duration());
  EXPECT_EQ(bent.path.rows(), 81);
  EXPECT_LT((bent.eval(0.).q - C.getJointState()).norm(), 1e-12);
  EXPECT_LT((bent.eval(bent.duration()).q - kGoal).norm(), 1e-9);
  EXPECT_LT(bent.eval(bent.duration()).velocity.norm(), 1e-6);
  EXPECT_GE(bent.clearance(), .02 - 1e-5);
  const int disc = C.getFrame("body").id();
  for (double t = 0.; t <= bent.duration(); t += 1e-3) {
    const MotionState state = bent.eval(t);
    EXPECT_LE(state.velocity.cwiseAbs().maxCoeff(), 1. + 1e-9);
    EXPECT_LE(state.acceleration.cwiseAbs().maxCoeff(), 2. + 1e-9);
    C.setJointState(state.q);
    for (const Config::NearPair& pair : C.getCollisions(.02 - 1e-5)) EXPECT_TRUE(pair.a != disc && pair.b != disc) << t;
  }
}

TEST(SmoothMotion, GivesTheSameBitsAtAnyNumberOfThreads) {
  const MotionPlan one = planMotion(posts(), kGoal, options(60)), two = planMotion(posts(), kGoal, options(60, 2));
  EXPECT_EQ(one.path, two.path);
  EXPECT_EQ(one.duration(), two.duration());
}

TEST(SmoothMotion, AStraightMotionStaysAsItIs) {
  Config C = posts();
  const VectorXd goal{{-2., .5}};
  const MotionPlan plan = planMotion(C, goal, options(40));
  ASSERT_TRUE(plan.feasible());
  EXPECT_EQ(plan.path.rows(), 2);
}

TEST(SmoothMotion, WhoWatchesMayEndIt) {
  Config C = posts();
  const MotionPlan plan = planMotion(C, kGoal, options(0));
  const MotionLimits limits = planLimits(C, options(0));
  const State state = C.state();
  const JointSpace space(*C.model());
  Steering steering({.scene = &state, .space = &space, .clearance = {.margin = .02}});
  int asked = 0;
  EXPECT_TRUE(smoothMotion(C, steering, plan.timed_path, limits, .02, 80, [&] { return ++asked < 0; }));
  EXPECT_GT(asked, 3);
  EXPECT_FALSE(smoothMotion(C, steering, plan.timed_path, limits, .02, 80, [] { return true; }));
}

TEST(SmoothMotion, IsForTheTimeAloneAmongWhatStandsStill) {
  PlanOptions by_length = options(80);
  by_length.optimize = "length";
  expectError<ValueError>([&] { planMotion(posts(), kGoal, by_length); }, {"slices needs optimize='time'"});
  expectError<ValueError>([&] { planMotion(posts(), kGoal, options(1)); }, {"slices is 1; expected 0, or 2 to"});
}
