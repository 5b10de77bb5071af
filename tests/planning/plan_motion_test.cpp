#include "kinegraph/planning/plan_motion.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

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
    C.setJointState(plan.eval(i / 3000. * plan.duration()).q);
    ASSERT_TRUE(C.getCollisions(.02 - 1e-9).empty()) << i;
  }
  EXPECT_GE(plan.clearance(), .02 - 1e-4);
}

TEST(PlanMotion, ADoorThatIsTooNarrowIsProvenToBe) {
  const MotionPlan plan = planMotion(roomForABox(.28), kGoal, {.max_evaluations = 2000});
  EXPECT_EQ(plan.status, PlanStatus::infeasible);
  EXPECT_NE(plan.message.find("a ball of 150 mm inside of 'body' does not get past 'left', 'right'"), std::string::npos)
      << plan.message;
}

/// A body on a base of these joints, before two walls that leave a door.
Config roomForA(const std::string& body, const std::string& joints, double door) {
  Config C;
  C.addText(cat("world: {}\nbase(world): {joint: ", joints, "}\nbody(base): {", body, ", contact: 1}"));
  for (const double side : {1., -1.}) {
    Frame wall = C.addFrame(side > 0. ? "left" : "right");
    wall.setShape(ShapeType::ssBox, {.2, 3., 1., .01}).setPosition({0., side * (.5 * door + 1.5), 0.}).setContact(1);
  }
  return C;
}

TEST(PlanMotion, WhatStandsUprightIsWiderThanTheBallInIt) {
  const std::string turns = "transXYPhi, limits: [-2, -2, -4, 2, 2, 4]",
                    slides = "trans3, limits: [-2, -2, -.1, 2, 2, .1]";
  struct Case {
    std::string body, joints, words;
    double too_narrow, wide_enough;
  };
  for (const auto& [body, joints, words, too_narrow, wide_enough] :
       {Case{"shape: cylinder, size: [.1, .2]", turns, "'body'", .38, .41},
        Case{"shape: ssBox, size: [.5, .4, .1, .02]", turns, "an upright cylinder of radius 200 mm inside of 'body'",
             .38, .41},
        Case{"shape: ssBox, size: [.1, .4, .1, .02]", slides, "'body'", .36, .41},
        Case{"Q: [0, 0, 0, .9, .4, 0, 0], shape: cylinder, size: [.1, .2]", slides, "'body'", .3, .41}}) {
    for (const double door : {too_narrow, wide_enough}) {
      const Config C = roomForA(body, joints, door);
      const VectorXd start{{-1., .5, 0.}}, goal{{1., 1., 0.}};
      const MotionPlan plan = planMotion(C, goal, {.max_evaluations = 200}, start);
      if (door == too_narrow) {
        EXPECT_EQ(plan.status, PlanStatus::infeasible) << body << plan.message;
        EXPECT_NE(plan.message.find("there is no path: " + words + " does not get past"), std::string::npos)
            << plan.message;
      } else {
        EXPECT_NE(plan.status, PlanStatus::infeasible) << body << plan.message;
      }
    }
  }
  // A cylinder that tips over gets through a door that is wider than it is long.
  const Config C = roomForA("shape: cylinder, size: [.1, .2]",
                            "free, limits: [-2, -2, -2, -1, -1, -1, -1, 2, 2, 2, 1, 1, 1, 1]", .3);
  VectorXd start = VectorXd::Zero(7), goal = start;
  start.head<4>() << -1., .5, 0., 1., goal.head<4>() << 1., 1., 0., 1.;
  EXPECT_NE(planMotion(C, goal, {.max_evaluations = 200}, start).status, PlanStatus::infeasible);
}

TEST(PlanMotion, ADoorThatIsWideEnoughIsNotProvenAway) {
  for (const double door : {.31, .35, .4}) {
    const MotionPlan plan = planMotion(roomForABox(door), kGoal, {.max_evaluations = 200});
    EXPECT_NE(plan.status, PlanStatus::infeasible) << door;
  }
}

TEST(PlanMotion, TheTimeLimitAndTheWatchEndTheProof) {
  const MotionPlan late = planMotion(roomForABox(.28), kGoal, {.time_limit = 1e-6});
  EXPECT_EQ(late.status, PlanStatus::timeout) << late.message;
  int asked = 0;
  const CancellationToken cancellation = [&] { return ++asked > 200; };
  const MotionPlan stopped = planMotion(roomForABox(.28), kGoal, {.max_evaluations = 1}, std::nullopt, cancellation);
  EXPECT_EQ(stopped.status, PlanStatus::cancelled) << stopped.message;
}

TEST(PlanMotion, ProofAndTimingAreLeftOutWhereNobodyAsksForThem) {
  const MotionPlan none = planMotion(roomForABox(.28), kGoal, {.max_evaluations = 2000, .prove_infeasibility = false});
  EXPECT_EQ(none.status, PlanStatus::no_path_found);
  const MotionPlan timed = planMotion(roomForABox(.5), kGoal),
                   path = planMotion(roomForABox(.5), kGoal, {.timing = false});
  ASSERT_TRUE(path.feasible());
  EXPECT_EQ(path.path, timed.path);
  EXPECT_EQ(path.times().size(), 0);
  EXPECT_EQ(path.str().find(" s"), std::string::npos) << path.str();
  EXPECT_THROW(path.eval(0.), ValueError);
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

TEST(PlanMotion, AnUnknownFrameOfATargetIsReportedByPlanMotion) {
  const auto messageOf = [](const std::vector<IkTarget>& targets) {
    try {
      planMotion(roomForABox(.5), targets);
    } catch (const FrameNotFound& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const IkTarget known = IkTarget::toPosition("body", Vector3d::Zero());
  EXPECT_EQ(messageOf({IkTarget::toPosition("bdy", Vector3d::Zero())}).substr(0, 28), "planMotion: frame name 'bdy'");
  EXPECT_EQ(messageOf({known.relativeTo("nothing")}).substr(0, 32), "planMotion: frame name 'nothing'");
}

}  // namespace
}  // namespace kinegraph
