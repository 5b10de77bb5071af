#include "kinegraph/motion/plan_motion.h"

#include <gtest/gtest.h>

#include "kinegraph/base/errors.h"

namespace kinegraph {
namespace {

/// A box on wheels, .5 m by .3 m, and two walls with a door of that width.
Config roomForABox(double door) {
  Config C;
  C.addText(R"(
world: {}
base(world): {joint: transXYPhi, limits: [-2, -2, -4, 2, 2, 4]}
body(base): {shape: ssBox, size: [0.5, 0.3, 0.4, 0.02], contact: 1}
)");
  for (const double side : {-1., 1.}) {
    Frame wall = C.addFrame(side > 0. ? "right" : "left");
    wall.setShape(ShapeType::box, {.1, 3., 1.}).setPosition({0., side * (1.5 + .5 * door), 0.});
    wall.setContact(1);
  }
  C.setJointState(VectorXd{{-1., 1.2, 1.57}});
  return C;
}

const VectorXd kGoal{{1., 1., 1.57}};

TEST(PlanMotion, GoesThroughADoorInTimeAndKeepsTheMargin) {
  Config C = roomForABox(.5);
  const MotionPlan plan = planMotion(C, kGoal, {.margin = .02});
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_EQ(plan.path.row(0).transpose(), (VectorXd{{-1., 1.2, 1.57}}));
  EXPECT_EQ(plan.path.bottomRows(1).transpose(), kGoal);
  for (int i = 0; i <= 3000; ++i) {
    C.setJointState(plan.at(i / 3000. * plan.duration()).q);
    ASSERT_TRUE(C.getCollisions(.02 - 1e-9).empty()) << i;
  }
  EXPECT_GE(plan.clearance(), .02 - 1e-4);
}

TEST(PlanMotion, ADoorThatIsTooNarrowIsProvenToBe) {
  const MotionPlan plan = planMotion(roomForABox(.28), kGoal, {.evaluations = 2000});
  EXPECT_EQ(plan.status, PlanStatus::impossible);
  EXPECT_NE(plan.message.find("a ball of 150 mm inside of 'body' does not get past 'left', 'right'"), std::string::npos)
      << plan.message;
}

TEST(PlanMotion, ADoorThatIsWideEnoughIsNotProvenAway) {
  for (const double door : {.31, .35, .4}) {
    const MotionPlan plan = planMotion(roomForABox(door), kGoal, {.evaluations = 200});
    EXPECT_NE(plan.status, PlanStatus::impossible) << door;
  }
}

TEST(PlanMotion, ProofAndTimingAreLeftOutWhereNobodyAsksForThem) {
  const MotionPlan none = planMotion(roomForABox(.28), kGoal, {.evaluations = 2000, .proof = false});
  EXPECT_EQ(none.status, PlanStatus::no_way);
  const MotionPlan timed = planMotion(roomForABox(.5), kGoal),
                   path = planMotion(roomForABox(.5), kGoal, {.timing = false});
  ASSERT_TRUE(path.feasible());
  EXPECT_EQ(path.path, timed.path);
  EXPECT_EQ(path.times().size(), 0);
  EXPECT_EQ(path.str().find(" s"), std::string::npos) << path.str();
  EXPECT_THROW(path.at(0.), ValueError);
  EXPECT_THROW(planMotion(roomForABox(.5), kGoal, {.slices = 20, .timing = false}), ValueError);
}

TEST(PlanMotion, TheWatchEndsIt) {
  const MotionPlan plan = planMotion(roomForABox(.31), kGoal, {}, std::nullopt, [] { return true; });
  EXPECT_EQ(plan.status, PlanStatus::cancelled);
}

TEST(PlanMotion, AnEndlessJointKeepsTheTurnsOfItsStart) {
  Config C;
  C.addText("world: {}\narm(world): {joint: hingeZ}");
  const MotionPlan plan = planMotion(C, VectorXd(VectorXd::Constant(1, 0.)), {}, VectorXd(VectorXd::Constant(1, 12.)));
  ASSERT_TRUE(plan.feasible());
  EXPECT_EQ(plan.path(0, 0), 12.);
  EXPECT_NEAR(plan.path(1, 0), 4. * M_PI, 1e-12);
}

TEST(PlanMotion, AQuaternionIsTurnedTheShorterWay) {
  Config C;
  C.addText("world: {}\nball(world): {joint: quatBall}");
  const VectorXd goal{{-std::cos(.5), 0., -std::sin(.5), 0.}};
  const MotionPlan plan = planMotion(C, goal, {}, VectorXd{{1., 0., 0., 0.}});
  ASSERT_TRUE(plan.feasible());
  EXPECT_TRUE((plan.path.bottomRows(1).transpose() + goal).isZero(1e-12));
}

TEST(PlanMotion, GoalsOfSeveralKindsAreRefused) {
  MotionGoal goal(kGoal);
  goal.state = "home";
  EXPECT_THROW(planMotion(roomForABox(.5), goal), ValueError);
  EXPECT_THROW(planMotion(roomForABox(.5), MotionGoal()), ValueError);
}

}  // namespace
}  // namespace kinegraph
