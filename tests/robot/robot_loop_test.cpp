#include "kinegraph/robot/robot_loop.h"

#include <gtest/gtest.h>

#include "tests/robot/arm.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

std::shared_ptr<RecordedDriver> obedient() {
  return std::make_shared<RecordedDriver>(plainRobot(), std::vector<RobotState>(), pair(0., 0.));
}

RobotState state(double time, double q0 = 0.) { return {time, pair(q0, 0.), pair(0., 0.), {}, {}, {}, {}}; }

/// A driver that returns one bad state after `good` states.
std::shared_ptr<RecordedDriver> goesWrong(int good, const RobotState& wrong) {
  std::vector<RobotState> states;
  for (int i = 0; i < good; ++i) states.push_back(state(i * .01));
  states.push_back(wrong);
  return std::make_shared<RecordedDriver>(plainRobot(), states);
}

BSpline straight(double from, double to, double start, double end) {
  MatrixXd points(2, 2);
  points << from, 0., to, 0.;
  return BSpline(3, points, pair(start, end));
}

}  // namespace

TEST(RobotLoop, WritesTheReferenceAtTheEndOfEachPeriod) {
  const auto driver = obedient();
  RobotLoop loop(driver, .01);
  const BSpline motion = straight(0., .5, 0., 1.);
  loop.apply(FollowSpline{motion});
  for (int i = 0; i < 120; ++i) loop.step();
  ASSERT_EQ(driver->commands().size(), 120u);
  for (int i = 0; i < 120; ++i) {
    EXPECT_EQ(driver->commands()[std::size_t(i)].q, motion.eval((i + 1) * .01)) << i;
    EXPECT_EQ(driver->commands()[std::size_t(i)].velocity, motion.eval((i + 1) * .01, 1)) << i;
  }
  EXPECT_EQ(loop.state().q, pair(.5, 0.));
  EXPECT_EQ(loop.tick(), 120);
}

TEST(RobotLoop, IsStoppedByNumbersThatAreNotFinite) {
  RobotState wrong = state(.05);
  wrong.q[1] = NAN;
  const auto driver = goesWrong(4, wrong);
  RobotLoop loop(driver, .01);
  for (int i = 0; i < 10; ++i) loop.step();
  EXPECT_EQ(loop.mode(), LoopMode::fault);
  EXPECT_NE(loop.fault().find("not finite"), std::string::npos);
  ASSERT_EQ(driver->stops().size(), 1u);
  EXPECT_EQ(driver->commands().size(), 4u);  // no command follows
  EXPECT_EQ(loop.state().q, pair(0., 0.));   // the last valid state
}

TEST(RobotLoop, IsStoppedByAnErrorOfTheRobotUntilItRecovers) {
  RobotState wrong = state(.05);
  wrong.error = "joint 2: too hot";
  std::vector<RobotState> states = {state(0.), state(.01), wrong, state(.06, .2)};
  const auto driver = std::make_shared<RecordedDriver>(plainRobot(), states);
  RobotLoop loop(driver, .01);
  loop.step();
  loop.step();
  EXPECT_EQ(loop.fault(), "joint 2: too hot");
  expectError<RobotFault>([&] { loop.requireReady("move", pair(0., 0.)); },
                          {"move: the robot was stopped: joint 2: too hot"});
  expectError<RobotFault>([&] { loop.apply(FollowSpline{straight(0., 1., 0., 1.)}); }, {"too hot"});
  loop.apply(RecoverRobot{});
  EXPECT_EQ(driver->recoveries(), 1);
  EXPECT_EQ(loop.mode(), LoopMode::hold);
  EXPECT_EQ(loop.reference(loop.time()).row(0), row(.2, 0.));  // its q at the recovery
}

TEST(RobotLoop, IsStoppedByAClockThatStandsStill) {
  std::vector<RobotState> states(100, state(1.));
  const auto driver = std::make_shared<RecordedDriver>(plainRobot(), states);
  RobotLoop loop(driver, .01);
  int ticks = 0;
  while (loop.mode() != LoopMode::fault && ticks < 90) loop.step(), ++ticks;
  EXPECT_NE(loop.fault().find("clock has stood still"), std::string::npos);
  EXPECT_NEAR(ticks * .01, .1, .021);
}

TEST(RobotLoop, IsStoppedByADriverThatThrows) {
  struct Broken : RobotDriver {
    RobotInfo info() override { return plainRobot(); }
    RobotState read() override { return state(time += .01); }
    void write(const RobotCommand&) override {
      if (++writes == 3) throw RobotFault("the cable is out");
    }
    void stop(const std::string&) override { throw RobotFault("nobody listens"); }
    double time = 0.;
    int writes = 0;
  };
  const auto driver = std::make_shared<Broken>();
  RobotLoop loop(driver, .01);
  for (int i = 0; i < 5; ++i) loop.step();
  EXPECT_EQ(loop.fault(), "the cable is out; and stopping it failed: nobody listens");
  EXPECT_EQ(driver->writes, 3);
}

TEST(RobotLoop, RecoversFarFromItsLastCommand) {
  std::vector<RobotState> states;
  for (int i = 0; i < 100; ++i) states.push_back(state(i * .01));  // does not move
  const auto driver = std::make_shared<RecordedDriver>(plainRobot(), states);
  RobotLoop loop(driver, .01);
  loop.apply(FollowSpline{straight(0., 1., 0., .5)});
  for (int i = 0; i < 60 && loop.mode() != LoopMode::fault; ++i) loop.step();
  ASSERT_NE(loop.fault().find("from its command"), std::string::npos) << loop.fault();
  loop.apply(RecoverRobot{});
  EXPECT_EQ(loop.mode(), LoopMode::hold) << loop.fault();
  loop.step();
  EXPECT_EQ(loop.mode(), LoopMode::hold) << loop.fault();
  EXPECT_EQ(loop.reference(loop.time()).row(0), row(0., 0.));
}

TEST(RobotLoop, IsStoppedIfItDoesNotFollow) {
  std::vector<RobotState> states;
  for (int i = 0; i < 100; ++i) states.push_back(state(i * .01));  // does not move
  const auto driver = std::make_shared<RecordedDriver>(plainRobot(), states);
  RobotLoop loop(driver, .01);
  loop.apply(FollowSpline{straight(0., 1., 0., 1.)});
  for (int i = 0; i < 60; ++i) loop.step();
  EXPECT_NE(loop.fault().find("joint 'arm1' is 0.3"), std::string::npos) << loop.fault();
  EXPECT_NE(loop.fault().find("does an obstacle block it?"), std::string::npos);
  EXPECT_LT(driver->commands().back().q[0], .32);
}

TEST(RobotLoop, AddsTheWarningOfAJointThatDoesNotFollowToEarlierOnes) {
  RobotLoop loop(goesWrong(4, state(.05, 1.)), .01, {.lag_stops = false});
  loop.warn("the object is far away");
  for (int i = 0; i < 10; ++i) loop.step();
  const std::string warning = loop.takeWarning();
  EXPECT_TRUE(warning.starts_with("the object is far away; joint 'arm1' is 1 from its command")) << warning;
  EXPECT_EQ(loop.takeWarning(), "");
}

TEST(RobotLoop, DoesNotBeginWithARobotThatReportsAnError) {
  RobotState wrong = state(0.);
  wrong.error = "emergency stop";
  expectError<RobotFault>([&] { RobotLoop(goesWrong(0, wrong), .01); }, {"'plain' cannot move: emergency stop"});
  RobotState short_one = state(0.);
  short_one.q = VectorXd::Zero(3);
  expectError<RobotFault>([&] { RobotLoop(goesWrong(0, short_one), .01); }, {"a q of 3 numbers; expected 2"});
}

TEST(RobotLoop, RefusesAMotionThatBeginsFarFromTheRobot) {
  RobotLoop loop(obedient(), .01);
  loop.requireReady("move", pair(.04, 0.));
  expectError<RobotFault>([&] { loop.requireReady("move", pair(.06, 0.)); },
                          {"move: joint 'arm1' is at 0, 0.06 from the start of the motion; call hold() first"});
}

TEST(RobotLoop, BrakesToRestWithinItsLimits) {
  const auto driver = obedient();
  RobotLoop loop(driver, .01);
  loop.info().acceleration.setConstant(10.);
  loop.apply(FollowSpline{straight(0., 1., 0., 1.)});
  for (int i = 0; i < 50; ++i) loop.step();  // 1.5 rad/s
  const BSpline braking = loop.stoppingSegment(loop.time(), loop.reference(loop.time()));
  EXPECT_NEAR(braking.end() - loop.time(), 2. * 1.5 / 10., 1e-9);
  EXPECT_LE(peaksOf(braking, loop.time()).acceleration[0], 10. + 1e-9);
  loop.apply(HoldRobot{braking});
  for (int i = 0; i < 40; ++i) loop.step();
  EXPECT_NEAR(driver->commands().back().velocity[0], 0., 1e-12);
  EXPECT_NEAR(loop.state().q[0], .5 + 1.5 * .3 / 3., 1e-9);
}

TEST(RobotLoop, DoesNotAskAStiffRobotToBeCompliant) {
  RobotLoop loop(obedient(), .01);
  expectError<RobotFault>([&] { loop.apply(FloatRobot{}); }, {"'plain' cannot float"});
  expectError<RobotFault>([&] { loop.apply(SetStiffness{MatrixXd::Zero(2, 2)}); }, {"cannot be compliant"});
  expectError<RobotFault>([&] { loop.apply(GripperCommand{}); }, {"has no gripper 0"});
  expectError<RobotFault>([&] { loop.apply(PlaceFrame{}); }, {"is not simulated"});
  EXPECT_TRUE(loop.log().entries.empty());  // refused commands are not logged
}
