#include "kinegraph/planning/plan_from_velocity.h"

#include "kinegraph/common/errors.h"
#include "tests/planning/dynamic_room.h"
#include "tests/planning/plane_room.h"

namespace kinegraph {
namespace {

PlanOptions brisk() {
  PlanOptions options{.margin = .01};
  options.velocity = VectorXd::Constant(1, 1.);
  options.acceleration = VectorXd::Constant(1, 4.);
  return options;
}

/// The disc before a door, moving towards it.
struct Running {
  Config C = room(.8);
  MotionPlan plan;

  Running() {
    C.setJointState(VectorXd{{-1., 1.2}});
    plan = planMotion(C, VectorXd{{1., 1.}}, brisk());
  }
};

void expectGoesOn(const MotionPlan& before, double time, const MotionPlan& after) {
  const MotionState left = before.eval(time), taken = after.eval(0.);
  EXPECT_TRUE(taken.q.isApprox(left.q, 1e-12));
  EXPECT_TRUE(taken.velocity.isApprox(left.velocity, 1e-9))
      << taken.velocity.transpose() << " " << left.velocity.transpose();
}

TEST(PlanFromVelocity, ItGoesOnWithItsVelocityToAnotherGoal) {
  const Running running;
  ASSERT_TRUE(running.plan.feasible());
  const VectorXd goal{{-1., -1.2}};
  for (const double share : {.1, .3, .5, .7}) {
    const double time = share * running.plan.duration();
    const MotionPlan plan = running.plan.replan(running.C, time, MotionGoal(goal));
    ASSERT_TRUE(plan.feasible()) << share << plan.message;
    expectGoesOn(running.plan, time, plan);
    expectSmooth(plan, 1., 4.);
    EXPECT_TRUE(plan.eval(plan.duration()).q.isApprox(goal));
    EXPECT_GE(leastOfTime(running.C, plan, {}, 5e-4, 0.), .01 - 1e-9) << share;
  }
}

TEST(PlanFromVelocity, TheRestOfTheMotionStaysIfNothingHasChanged) {
  const Running running;
  const double time = .4 * running.plan.duration();
  const MotionPlan plan = running.plan.replan(running.C, time);
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_NEAR(plan.duration(), running.plan.duration() - time, 1e-2);
  expectGoesOn(running.plan, time, plan);
  EXPECT_EQ(plan.path.rows(), plan.times().size());
}

TEST(PlanFromVelocity, ItGoesAroundWhatHasAppeared) {
  Running running;
  const double time = .3 * running.plan.duration();
  Frame crate = running.C.addFrame("crate");
  crate.setShape(ShapeType::ssBox, {.3, .3, 1., .01}).setPosition({1., .3, 0.}).setContact(1);
  const MotionPlan plan = running.plan.replan(running.C, time);
  ASSERT_TRUE(plan.feasible()) << plan.message;
  expectGoesOn(running.plan, time, plan);
  expectSmooth(plan, 1., 4.);
  EXPECT_GE(leastOfTime(running.C, plan, {}, 5e-4, 0.), .01 - 1e-9);
}

TEST(PlanFromVelocity, WhereItCannotStopInTimeItSaysSo) {
  Running running;
  const MotionState now = running.plan.eval(.3 * running.plan.duration());
  const VectorXd ahead = now.q + .3 * now.velocity.normalized();
  Frame crate = running.C.addFrame("crate");
  crate.setShape(ShapeType::ssBox, {.1, .1, 1., .01}).setPosition({ahead[0], ahead[1], 0.}).setContact(1);
  const MotionPlan plan = running.plan.replan(running.C, .3 * running.plan.duration());
  EXPECT_FALSE(plan.feasible());
  EXPECT_NE(plan.message.find("cannot come to rest"), std::string::npos) << plan.message;
}

TEST(PlanFromVelocity, AVelocityAboveTheLimitIsRefused) {
  Config C = room(.8);
  PlanOptions options = brisk();
  options.start_velocity = VectorXd{{1.5, 0.}};
  const MotionPlan plan = planMotion(C, VectorXd{{-1., -1.}}, options, VectorXd{{-1.5, 1.2}});
  EXPECT_EQ(plan.status, PlanStatus::invalid_start);
  EXPECT_NE(plan.message.find("disc:0 is 1.5; its limit is 1"), std::string::npos) << plan.message;
  options.start_velocity = VectorXd{{1., 0., 0.}};
  EXPECT_THROW(planMotion(C, VectorXd{{-1., -1.}}, options), ValueError);
}

TEST(PlanFromVelocity, TheTimeLimitIsThatOfAllThatIsTried) {
  Config C = room(.8);
  PlanOptions options = brisk();
  options.start_velocity = VectorXd{{.5, 0.}};
  options.time_limit = 1e-9;
  const MotionPlan plan = planMotion(C, VectorXd{{1., -1.}}, options, VectorXd{{-1.5, 1.2}});
  EXPECT_EQ(plan.status, PlanStatus::timeout) << plan.message;
  EXPECT_NE(plan.message.find("time limit of 1e-09 s"), std::string::npos) << plan.message;
  options.time_limit = 1e300;
  EXPECT_TRUE(planMotion(C, VectorXd{{1., -1.}}, options, VectorXd{{-1.5, 1.2}}).feasible());
}

TEST(PlanFromVelocity, ItKeepsClearOfWhatMovesWhileItGoesOn) {
  Config C = discAndBox();
  PlanOptions options = brisk();
  const MotionPlan first = planMotion(C, VectorXd{{1., 0.}}, options);
  ASSERT_TRUE(first.feasible());
  options.obstacle_trajectories = {moves("cart", {{0., poseAt(.3, -1.)}, {1.5, poseAt(.3, .8)}})};
  const MotionPlan plan = first.replan(C, .6, std::nullopt, options);
  ASSERT_TRUE(plan.feasible()) << plan.message;
  expectGoesOn(first, .6, plan);
  expectSmooth(plan, 1., 4.);
  EXPECT_GE(leastOfTime(C, plan, options.obstacle_trajectories, 5e-4), .01 - 1e-9);
  // Times of obstacles count from the new motion on.
  const MotionPlan again = plan.replan(C, .2);
  ASSERT_TRUE(again.feasible()) << again.message;
  EXPECT_DOUBLE_EQ(again.options.obstacle_trajectories.front().times[1], 1.3);
}

TEST(PlanFromVelocity, LimitsOfTheJerkHoldFromTheFirstMomentOn) {
  Config C = room(.8);
  PlanOptions options = brisk();
  options.jerk = VectorXd::Constant(1, 30.);
  options.start_velocity = VectorXd{{.6, -.3}};
  const MotionPlan plan = planMotion(C, VectorXd{{1., 1.}}, options, VectorXd{{-1.2, 1.}});
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_TRUE(plan.eval(0.).velocity.isApprox(options.start_velocity, 1e-9));
  MotionState before = plan.eval(0.);
  EXPECT_LE(before.acceleration.norm(), 1e-6);
  for (double t = 1e-3; t <= plan.duration(); t += 1e-3) {
    const MotionState now = plan.eval(t);
    ASSERT_LE((now.acceleration - before.acceleration).cwiseAbs().maxCoeff(), 30. * 1e-3 * (1. + 1e-6) + 1e-9) << t;
    before = now;
  }
}

/// The same disc with jerk limits.
struct RunningGently {
  Config C = room(.8);
  MotionPlan plan;

  RunningGently() {
    PlanOptions options = brisk();
    options.jerk = VectorXd::Constant(1, 30.);
    plan = planMotion(C, VectorXd{{1., 1.}}, options, VectorXd{{-1., 1.2}});
  }
};

/// Checks the jerk limits of a motion that replaces another one from `time` on.
void expectGentle(const MotionPlan& before, double time, const MotionPlan& after) {
  const MotionState left = before.eval(time);
  EXPECT_LE((after.eval(0.).acceleration - left.acceleration).norm(), 1e-6);
  VectorXd last = left.acceleration;
  constexpr double kStep = 1e-3;
  for (double t = kStep; t <= after.duration(); t += kStep) {
    const VectorXd now = after.eval(t).acceleration;
    ASSERT_LE((now - last).cwiseAbs().maxCoeff(), 30. * kStep * (1. + 1e-6) + 1e-9) << t;
    last = now;
  }
}

TEST(PlanFromVelocity, ItGoesOnWithItsAccelerationToAnotherGoal) {
  const RunningGently running;
  ASSERT_TRUE(running.plan.feasible());
  for (const VectorXd& goal : {VectorXd{{-1., -1.2}}, VectorXd{{1.2, -1.}}}) {
    for (const double share : {.02, .1, .25, .4, .55, .7, .85, .95}) {
      const double time = share * running.plan.duration();
      const MotionPlan plan = running.plan.replan(running.C, time, MotionGoal(goal));
      ASSERT_TRUE(plan.feasible()) << share << plan.message;
      EXPECT_TRUE(plan.warnings.empty()) << share << " " << plan.warnings.front();
      expectGoesOn(running.plan, time, plan);
      expectSmooth(plan, 1., 4.);
      expectGentle(running.plan, time, plan);
      EXPECT_TRUE(plan.eval(plan.duration()).q.isApprox(goal));
      EXPECT_EQ(plan.path.rows(), plan.times().size());
      EXPECT_GE(leastOfTime(running.C, plan, {}, 5e-4, 0.), .01 - 1e-9) << share;
    }
  }
}

TEST(PlanFromVelocity, AmongWhatMovesItGoesOnWithItsAcceleration) {
  Config C = discAndBox();
  PlanOptions options = brisk();
  options.jerk = VectorXd::Constant(1, 30.);
  const MotionPlan first = planMotion(C, VectorXd{{1., .2}}, options);
  ASSERT_TRUE(first.feasible());
  int bent = 0;
  for (const std::optional<MotionGoal>& goal : {std::optional<MotionGoal>(), {MotionGoal(VectorXd{{.4, -1.}})}}) {
    for (const double share : {.03, .1, .2, .3, .4, .8}) {
      for (const double speed : {.6, 1.}) {
        const double time = share * first.duration(), begin = time - .4;
        options.obstacle_trajectories = {
            moves("cart", {{begin, poseAt(.4, -1.6)}, {begin + 2.4 / speed, poseAt(.4, .8)}})};
        PlanOptions later = options;
        later.obstacle_trajectories.front().times.array() -= time;
        const MotionPlan plan = first.replan(C, time, goal, later);
        ASSERT_TRUE(plan.feasible()) << share << " " << plan.message;
        for (const std::string& note : plan.warnings) EXPECT_EQ(note.find("without"), std::string::npos) << share;
        expectGoesOn(first, time, plan);
        expectSmooth(plan, 1., 4.);
        expectGentle(first, time, plan);
        EXPECT_GE(leastOfTime(C, plan, later.obstacle_trajectories, 5e-4), .01 - 1e-9) << share << " " << speed;
        bent += first.eval(time).acceleration.norm() > .1;
      }
    }
  }
  EXPECT_GE(bent, 12);  // of 24: there it has an acceleration
}

TEST(PlanFromVelocity, AmongWhatMovesAStartAccelerationIsThatOfTheMotion) {
  Config C = discAndBox();
  PlanOptions options = brisk();
  options.jerk = VectorXd::Constant(1, 30.);
  options.start_velocity = VectorXd{{.5, .2}};
  options.start_acceleration = VectorXd{{1.5, -1.}};
  options.obstacle_trajectories = {moves("cart", {{0., poseAt(.2, -1.4)}, {2.4, poseAt(.2, 1.)}})};
  const MotionPlan plan = planMotion(C, VectorXd{{1., 0.}}, options);
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_TRUE(plan.eval(0.).velocity.isApprox(options.start_velocity, 1e-9));
  EXPECT_TRUE(plan.eval(0.).acceleration.isApprox(options.start_acceleration, 1e-6));
  EXPECT_GE(leastOfTime(C, plan, options.obstacle_trajectories, 5e-4), .01 - 1e-9);
}

TEST(PlanFromVelocity, TheRestOfAGentleMotionIsThatMotion) {
  const RunningGently running;
  const double time = .3 * running.plan.duration();
  const MotionPlan plan = running.plan.replan(running.C, time);
  ASSERT_TRUE(plan.feasible()) << plan.message;
  EXPECT_NEAR(plan.duration(), running.plan.duration() - time, 1e-12);
  for (double t = 0.; t < plan.duration(); t += .01) {
    const MotionState now = plan.eval(t), then = running.plan.eval(time + t);
    ASSERT_LE((now.q - then.q).norm(), 1e-9) << t;
    ASSERT_LE((now.acceleration - then.acceleration).norm(), 1e-7) << t;
  }
}

TEST(PlanFromVelocity, AStartAccelerationThatMakesNoSenseIsRefused) {
  Config C = room(.8);
  PlanOptions options = brisk();
  options.start_velocity = VectorXd{{.5, 0.}};
  options.start_acceleration = VectorXd{{1., 0.}};
  EXPECT_THROW(planMotion(C, VectorXd{{-1., -1.}}, options), ValueError);  // no jerk limits
  options.jerk = VectorXd::Constant(1, 30.);
  options.start_acceleration = VectorXd{{4.5, 0.}};
  const MotionPlan plan = planMotion(C, VectorXd{{-1., -1.}}, options, VectorXd{{-1.5, 1.2}});
  EXPECT_EQ(plan.status, PlanStatus::invalid_start);
  EXPECT_NE(plan.message.find("start acceleration of disc:0 is 4.5; its limit is 4"), std::string::npos)
      << plan.message;
  options.start_acceleration = VectorXd{{1.}};
  EXPECT_THROW(planMotion(C, VectorXd{{-1., -1.}}, options), ValueError);
}

}  // namespace
}  // namespace kinegraph
