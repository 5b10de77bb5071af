#include "kinegraph/robot/bot_op.h"

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>

#include "kinegraph/robot/drivers.h"
#include "tests/robot/arm.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

struct Bench {
  Config C = twoJointArm();
  BotOp bot{C, std::make_shared<KinematicDriver>(C)};

  double now() const { return .01 * double(bot.getLog().ticks); }
};

/// A script with motions, grasps, pauses and queries.
CommandLog runScript(BotOp& bot, Config& C) {
  MatrixXd path(3, 2);
  path << .2, -.1, .5, .3, .4, .6;
  bot.move(path, seconds(1.5));
  bot.gripperMove(0, .02);
  bot.sync(C, .333);
  bot.moveTo(pair(0., .1), 2., true);
  bot.wait(C);
  bot.gripperCloseGrasp(0, "box");
  while (!bot.gripperDone(0)) bot.sync(C, .02);
  bot.moveTo(pair(-.3, .1));
  bot.sync(C, .2);
  bot.hold();
  bot.sync(C, .1);
  return bot.getLog();
}

}  // namespace

TEST(BotOp, NeedsARobot) {
  Config nothing;
  nothing.addText("ball: { shape: sphere, size: [.1], mass: 1 }");
  expectError<ValueError>([&] { BotOp bot(nothing); }, {"no active joints"});
}

TEST(BotOp, TakesTheTimeOfItsArgument) {
  for (const int count : {1, 2, 5}) {
    Bench b;
    MatrixXd path(count, 2);
    for (int i = 0; i < count; ++i) path.row(i) = row(.4 * (i + 1) / count, 0.);
    b.bot.move(path, seconds(2.));
    EXPECT_NEAR(b.bot.getTimeToEnd(), 2., 1e-12) << count;
    b.bot.wait(b.C);
    EXPECT_NEAR(b.bot.get_t(), 2., 1e-9) << count;
    EXPECT_LT((b.bot.get_q() - pair(.4, 0.)).norm(), 1e-12);
    EXPECT_LT((b.C.getJointState() - pair(.4, 0.)).norm(), 1e-12);
  }
}

TEST(BotOp, TimesOfPointsCountFromTheEndOfWhatItDoes) {
  Bench b;
  b.bot.move(row(.2, 0.), seconds(1.));
  MatrixXd path(2, 2);
  path << .1, .1, 0., .3;
  b.bot.move(path, pair(.5, 1.5));
  EXPECT_NEAR(b.bot.getTimeToEnd(), 2.5, 1e-12);
  b.bot.sync(b.C, 1.);
  EXPECT_LT((b.bot.get_q() - pair(.2, 0.)).norm(), 1e-12);  // passes through the previous end, at rest
  EXPECT_LT(b.bot.get_qDot().norm(), 1e-12);
}

TEST(BotOp, MoveToTakesTheTimeOfItsFormulaOrWhatLimitsNeed) {
  Bench b;
  b.bot.moveTo(pair(.2, 0.));
  EXPECT_NEAR(b.bot.getTimeToEnd(), std::sqrt(6. * .2), 1e-12);
  b.bot.wait(b.C);
  b.bot.moveTo(pair(.2, 0.));
  EXPECT_NEAR(b.bot.getTimeToEnd(), .1, 1e-9);  // at least
  b.bot.wait(b.C);
  b.bot.moveTo(pair(-1., 0.), 100.);                        // .27 s by the formula: 6.7 rad/s
  EXPECT_NEAR(b.bot.getTimeToEnd(), 1.5 * 1.2 / 2., 1e-6);  // at 2 rad/s
}

TEST(BotOp, OverwritesSmoothly) {
  Bench b;
  b.bot.move(row(.5, 0.), seconds(1.));
  b.bot.sync(b.C, .5);
  const VectorXd before = b.bot.get_qDot();
  EXPECT_NEAR(before[0], .75, 1e-9);
  b.bot.move(row(0., .5), seconds(1.), true);
  EXPECT_NEAR(b.bot.getTimeToEnd(), 1., 1e-12);
  b.bot.sync(b.C, .01);
  EXPECT_NEAR(b.bot.get_qDot()[0], .75, .1);
  b.bot.wait(b.C);
  EXPECT_LT((b.bot.get_q() - pair(0., .5)).norm(), 1e-12);
}

/// The references of q and velocity at the end of each period.
std::vector<std::pair<VectorXd, VectorXd>> referencesUntil(double end, BotOp& bot, Config& C) {
  std::vector<std::pair<VectorXd, VectorXd>> references;
  while (double(bot.getLog().ticks) * .01 < end - 1e-9) {
    bot.sync(C, .01);
    const StepObservation now = bot.stepObservation();
    references.emplace_back(now.qref, now.qvel_ref);
  }
  return references;
}

/// Another motion replaces the first one from the time `cut` on.
void expectTakesOver(const std::function<std::shared_ptr<RobotDriver>(const Config&)>& driver, double cut) {
  Config C = twoJointArm();
  C.getFrame("box").setPosition({0., 0., 1.});  // out of reach
  const auto robot = [&] { return std::make_unique<BotOp>(C, driver(C)); };
  const auto begin = [&](BotOp& bot) {
    MatrixXd path(3, 2);
    path << .3, -.2, .1, .4, .6, .2;
    bot.move(path, seconds(1.5));
    bot.sync(C, .305);
  };
  const auto alone = robot(), both = robot();
  begin(*alone);
  begin(*both);
  MatrixXd path(2, 2);
  path << -.2, .1, 0., -.3;
  both->move(path, pair(.6, 1.5), true, cut);
  EXPECT_NEAR(both->getTimeToEnd(), cut + 1.5 - .3, 1e-9);
  const auto earlier = referencesUntil(cut + 2., *alone, C), references = referencesUntil(cut + 2., *both, C);
  ASSERT_EQ(earlier.size(), references.size());
  const BSpline first = std::get<FollowSpline>(alone->getLog().entries[0].command).motion;
  MatrixXd points(3, 2);
  points << first.eval(cut).transpose(), path;
  const BSpline second(3, points, Eigen::Vector3d(cut, cut + .6, cut + 1.5), first.eval(cut, 1));
  for (std::size_t i = 0; i < references.size(); ++i) {
    const double t = .01 * double(i + 31);
    const VectorXd q = t <= cut ? earlier[i].first : second.eval(t),
                   velocity = t <= cut ? earlier[i].second : second.eval(t, 1);
    EXPECT_LT((references[i].first - q).cwiseAbs().maxCoeff(), 1e-9) << t;
    EXPECT_LT((references[i].second - velocity).cwiseAbs().maxCoeff(), 1e-9) << t;
  }
  EXPECT_LT((both->stepObservation().qpos - pair(0., -.3)).norm(), 1e-3);
}

TEST(BotOp, OverwritesFromALaterTimeOn) {
  for (const double cut : {.455, .85, 1.2, 1.5, 1.8}) {  // the last one comes after the end of the motion
    SCOPED_TRACE(cut);
    expectTakesOver([](const Config& C) { return std::make_shared<KinematicDriver>(C); }, cut);
    expectTakesOver([](const Config& C) { return std::make_shared<SimulatedDriver>(C); }, cut);
  }
}

TEST(BotOp, OverwritesFromALaterTimeOnWhateverItDoes) {
  Bench b;
  b.bot.sync(b.C, .1);
  b.bot.move(row(.2, 0.), seconds(.5), true, .3);  // it is at rest
  b.bot.sync(b.C, .2);
  EXPECT_EQ(b.bot.get_q(), pair(0., 0.));
  b.bot.sync(b.C, .25);
  EXPECT_NEAR(b.bot.get_q()[0], .1, 1e-9);
  b.bot.hold();
  const double braked = b.now() + .05;
  b.bot.move(row(0., 0.), seconds(.5), true, braked + .1);
  b.bot.sync(b.C, .15);
  EXPECT_LT(b.bot.get_qDot().norm(), 1e-12);
  EXPECT_GT(b.bot.get_q()[0], .1);
  b.bot.wait(b.C);
  EXPECT_LT(b.bot.get_q().norm(), 1e-12);
  b.bot.floating();
  b.bot.move(row(.1, 0.), seconds(.5), true, b.now() + .2);
  b.bot.sync(b.C, .2);
  EXPECT_LT(b.bot.get_q().norm(), 1e-12);
  b.bot.wait(b.C);
  EXPECT_LT((b.bot.get_q() - pair(.1, 0.)).norm(), 1e-12);
  b.bot.move(row(1.9, 0.), seconds(3.), true, b.now() + .1);
  expectError<ValueError>([&] { b.bot.move(row(1., 0.), seconds(.2), true, b.now() + .5); },
                          {"BotOp::move", "'arm1'", "its limit is 2"});
}

TEST(BotOp, MovesAsFastAsLimitsAllow) {
  Bench b;
  MatrixXd path(4, 2);
  path << .2, .1, .4, -.1, .6, .2, 1., 0.;
  b.bot.moveAutoTimed(path, 1.5, 3.);
  double fastest = 0., hardest = 0.;
  VectorXd last = b.bot.get_qDot();
  while (b.bot.getTimeToEnd() > 0.) {
    b.bot.sync(b.C, .01);
    const VectorXd velocity = b.bot.get_qDot();
    fastest = std::max(fastest, velocity.cwiseAbs().maxCoeff());
    hardest = std::max(hardest, (velocity - last).cwiseAbs().maxCoeff() / .01);
    last = velocity;
  }
  EXPECT_LE(fastest, 1.5 + 1e-9);
  EXPECT_LE(hardest, 3. + 1e-6);
  EXPECT_TRUE(fastest > 1.49 || hardest > 2.8) << fastest << " " << hardest;
}

TEST(BotOp, RefusesMotionsBeyondLimitsAndDoesNothing) {
  Bench b;
  const auto refused = [&](const MatrixXd& path, const VectorXd& times, std::initializer_list<const char*> parts) {
    expectError<ValueError>([&] { b.bot.move(path, times); }, parts);
  };
  refused(row(1., 0.), seconds(.5),
          {"BotOp::move",
           "'arm1' would have a velocity of 3 /s 0.25 s after the start of the motion; its limit is 2 /s; take at "
           "least 1.5"});
  refused(row(2.5, 0.), seconds(9.), {"'arm1' would go to 2.5; its limits are -2 to 2"});
  refused(MatrixXd::Zero(1, 3), seconds(1.), {"points have 3 numbers; the robot has 2 joints"});
  refused(MatrixXd::Zero(3, 2), pair(1., 2.), {"3 points and 2 times"});
  refused(row(NAN, 0.), seconds(1.), {"not finite"});
  refused(row(.1, 0.), seconds(-1.), {"the time is -1"});
  EXPECT_TRUE(b.bot.getLog().entries.empty());
  b.bot.setLimits({}, seconds(1.), {});
  refused(row(1., 0.), seconds(2.), {"1.5 /s^2", "its limit is 1 /s^2"});
  b.bot.moveTo(pair(1., 0.), 10.);  // extends the duration automatically
  EXPECT_NEAR(b.bot.getTimeToEnd(), std::sqrt(6.), 1e-6);
  expectError<ValueError>([&] { b.bot.setLimits(seconds(-1.), {}, {}); }, {"velocity[0] is -1"});
}

TEST(BotOp, APollingLoopUntilTheEndOfAMotionTerminates) {
  Bench b;
  b.bot.move(row(.3, 0.), seconds(.5));
  int asked = 0;
  while (b.bot.getTimeToEnd() > 0.) ++asked;
  EXPECT_EQ(asked, 50);
  b.bot.gripperMove(0, 0.);
  while (!b.bot.gripperDone(0)) ASSERT_LT(++asked, 1000);
  EXPECT_EQ(b.bot.getGripperPos(0), 0.);
  const double t = b.bot.get_t();
  EXPECT_EQ(b.bot.get_qHome(), pair(0., 0.));
  EXPECT_NEAR(b.bot.get_t(), t + .01, 1e-12);  // a repeated query at the same time
}

TEST(BotOp, TheSameCallsGiveTheSameBits) {
  Bench one, two;
  const CommandLog log = runScript(one.bot, one.C);
  runScript(two.bot, two.C);
  EXPECT_EQ(log.text(), two.bot.getLog().text());
  EXPECT_EQ(one.C.getFrameState(), two.C.getFrameState());
}

TEST(BotOp, ReplaysALogToTheBit) {
  Bench one, again, read;
  const CommandLog log = runScript(one.bot, one.C);
  again.bot.replay(log);
  EXPECT_EQ(again.bot.getLog().text(), log.text());
  again.bot.update(again.C);
  EXPECT_EQ(again.C.getFrameState(), one.C.getFrameState());
  read.bot.replay(CommandLog::fromText(log.text()));
  EXPECT_EQ(read.bot.get_q(), again.bot.get_q());
  expectError<ValueError>([&] { read.bot.replay(log); }, {"moved before; expected a new BotOp"});
  CommandLog other = log;
  other.period = .02;
  Bench fresh;
  expectError<ValueError>([&] { fresh.bot.replay(other); }, {"period of the log is 0.02 s"});
}

TEST(BotOp, WhatIsGraspedByNameMovesWithTheHand) {
  Bench b;
  b.bot.gripperCloseGrasp(0, "box", 10., .03);
  b.bot.wait(b.C, false, false, true);
  EXPECT_NEAR(b.bot.getGripperPos(0), .03, 1e-12);
  b.bot.moveTo(pair(.5, 0.));
  b.bot.wait(b.C);
  EXPECT_LT((b.C.getFrame("box").getPosition() - Vector3d(.9 * std::cos(.5), .9 * std::sin(.5), 0.)).norm(), 1e-9);
  b.bot.gripperMove(0);
  b.bot.moveTo(pair(0., 0.));
  b.bot.wait(b.C);
  EXPECT_NEAR(b.C.getFrame("box").getPosition().y(), .9 * std::sin(.5), 1e-9);  // stayed
  EXPECT_NEAR(b.bot.getGripperPos(0), .07, 1e-12);                              // as wide as the fingers open
  expectError<FrameNotFound>([&] { b.bot.gripperCloseGrasp(0, "bax"); }, {"bax", "box"});
  expectError<ValueError>([&] { b.bot.gripperMove(2); }, {"no gripper 2; the robot has 1: gripper"});
}

TEST(BotOp, ThingsAreAttachedFreedAndPut) {
  Bench b;
  b.bot.attach("gripper", "box");
  b.bot.moveTo(pair(.5, 0.));
  b.bot.wait(b.C);
  EXPECT_GT(b.C.getFrame("box").getPosition().y(), .4);
  b.bot.detach("gripper", "box");
  b.bot.setFramePose("box", Pose({.1, .2, .3}, Quaterniond(0., 1., 0., 0.)));
  b.bot.home(b.C);
  EXPECT_LT((b.C.getFrame("box").getPosition() - Vector3d(.1, .2, .3)).norm(), 1e-12);
  EXPECT_LT(b.bot.get_q().norm(), 1e-12);
  expectError<FrameNotFound>([&] { b.bot.attach("gripper", "bax"); }, {"bax"});
}

TEST(BotOp, HoldsWhereItIsAndStops) {
  Bench b;
  b.bot.move(row(1., 0.), seconds(1.));
  b.bot.sync(b.C, .5);
  b.bot.hold();
  EXPECT_EQ(b.bot.getTimeToEnd(), 0.);
  b.bot.sync(b.C, .1);
  EXPECT_LT(b.bot.get_qDot().norm(), 1e-12);
  EXPECT_NEAR(b.bot.get_q()[0], .5 + 1.5 * .05 / 3., 1e-9);
  b.bot.move(row(0., 0.), seconds(1.));
  b.bot.sync(b.C, .5);
  b.bot.stop(b.C);
  EXPECT_LT(b.bot.get_qDot().norm(), 1e-12);
  EXPECT_EQ(b.bot.getMode(), LoopMode::hold);
}

TEST(BotOp, CancellationHoldsTheRobot) {
  struct Cancelled {};
  Config C = twoJointArm();
  BotOpOptions options;
  options.hyper_speed = 1.;
  options.watched = [] { return true; };  // at the pace of the wall clock
  int looks = 0;
  options.cancellation = [&] {
    if (++looks > 4) throw Cancelled();
  };
  BotOp bot(C, std::make_shared<KinematicDriver>(C), options);
  bot.move(row(1., 0.), seconds(2.));
  EXPECT_THROW(bot.wait(C), Cancelled);
  EXPECT_EQ(bot.getMode(), LoopMode::hold);
  EXPECT_LT(bot.getLog().ticks, 50);
  const CommandLog log = bot.getLog();
  EXPECT_TRUE(std::holds_alternative<HoldRobot>(log.entries.back().command));
}

TEST(BotOp, StepsOfAPolicyAccelerateConstantly) {
  Bench b;  // recorded from robotic 0.4.2: .0062 after .1 s and .0160 after .16 s
  b.bot.stepAction(pair(.05, 0.), b.bot.stepObservation(), .2);
  b.bot.sync(b.C, .1);
  EXPECT_NEAR(b.bot.stepObservation().qref[0], .00625, 1e-12);
  b.bot.sync(b.C, .06);
  EXPECT_NEAR(b.bot.stepObservation().qref[0], .016, 1e-12);
  b.bot.sync(b.C, .3);
  EXPECT_NEAR(b.bot.stepObservation().qref[0], .05, 1e-12);  // .025 in each half
  EXPECT_EQ(b.bot.stepObservation().qvel_ref.norm(), 0.);
  for (int i = 0; i < 300; ++i) {  // a policy: to (.4, -.2)
    const StepObservation now = b.bot.stepObservation();
    b.bot.stepAction(pair(.4, -.2) - now.qref, now, .1);
    b.bot.sync(b.C, .02);
  }
  EXPECT_LT((b.bot.get_q() - pair(.4, -.2)).norm(), 1e-3);
}

TEST(BotOp, StepsBeyondLimitsAreCutOff) {
  Bench b;
  b.bot.setLimits(seconds(.5), seconds(2.), {});
  VectorXd last = b.bot.get_q();
  for (int i = 0; i < 100; ++i) {
    b.bot.stepAction(pair(3., 0.), b.bot.stepObservation(), .3, 100.);
    b.bot.sync(b.C, .01);
    const VectorXd q = b.bot.get_q();
    EXPECT_LE((q - last).cwiseAbs().maxCoeff(), .5 * .01 + 1e-9);
    last = q;
  }
  EXPECT_GT(last[0], .2);
}

TEST(BotOp, EveryWaitingCallReportsAFaultUntilRecovery) {
  RobotState good{0., pair(0., 0.), pair(0., 0.), {}, {}, {}, {}}, wrong = good;
  wrong.error = "protective stop";
  std::vector<RobotState> states;
  for (int i = 0; i < 20; ++i) {
    states.push_back(i == 5 ? wrong : good);
    states.back().time = i * .01;
  }
  Config C = twoJointArm();
  BotOp bot(C, std::make_shared<RecordedDriver>(plainRobot(), states));
  bot.move(row(.02, 0.), seconds(.3));
  expectError<RobotFault>([&] { bot.wait(C); },
                          {"was stopped: protective stop; resolve the cause, then call recover()"});
  EXPECT_EQ(bot.getFault(), "protective stop");
  expectError<RobotFault>([&] { bot.moveTo(pair(0., 0.)); }, {"protective stop"});
  bot.recover();
  EXPECT_EQ(bot.getFault(), "");
  bot.sync(C, .05);
}

TEST(BotOp, RealTimeAdvancesWithoutCalls) {
  Config C = twoJointArm();
  BotOpOptions options;
  options.realtime = true;
  options.hyper_speed = 20.;
  const auto begin = std::chrono::steady_clock::now();
  BotOp bot(C, std::make_shared<KinematicDriver>(C), options);
  bot.move(row(.3, 0.), seconds(1.));
  bot.wait(C);
  EXPECT_LE(bot.getTimeToEnd(), 0.);
  EXPECT_LT((bot.get_q() - pair(.3, 0.)).norm(), 1e-12);
  const double time = bot.get_t();
  EXPECT_GE(time, 1.);
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
  EXPECT_LE(time, options.hyper_speed * passed.count() + options.period) << "what was late is caught up with, no more";
  Bench again;  // the log repeats the motion in virtual time
  again.bot.replay(bot.getLog());
  EXPECT_LT((again.bot.get_q() - pair(.3, 0.)).norm(), 1e-12);
}

TEST(BotOp, DoesNotTakeARobotWithOtherJoints) {
  Config C = twoJointArm();
  RobotInfo three = plainRobot();
  three.joints.push_back("arm3");
  for (VectorXd* limits : {&three.lower, &three.upper, &three.velocity, &three.acceleration, &three.effort})
    *limits = VectorXd::Constant(3, 1.);
  const auto driver = std::make_shared<RecordedDriver>(three, std::vector<RobotState>(), VectorXd::Zero(3));
  expectError<ValueError>([&] { BotOp(C, driver); },
                          {"robot 'plain' has 3 joints; the configuration has 2: arm1, arm2"});
}

TEST(BotOp, RecordsARowForEachPeriod) {
  const TemporaryFolder folder;
  Bench b;
  b.bot.recordTo((folder / "run.dat").string());
  b.bot.move(row(.1, 0.), seconds(.1));
  b.bot.sync(b.C, .1);
  b.bot.recordTo("");
  std::ifstream file(folder / "run.dat");
  std::string line;
  int rows = -1;  // the first line is a comment
  while (std::getline(file, line)) ++rows;
  EXPECT_EQ(rows, 10);
  expectError<FileError>([&] { b.bot.recordTo((folder / "none/run.dat").string()); }, {"cannot write"});
}

TEST(BotOp, AsksForRowsOfAJacobianThatAreIndependent) {
  Bench b;
  b.bot.setCompliance(row(1., 0.), .5);
  const CommandLog log = b.bot.getLog();
  EXPECT_LT((std::get<SetStiffness>(log.entries.back().command).stiffness -
             Eigen::Vector2d(.5, 1.).asDiagonal().toDenseMatrix())
                .norm(),
            1e-12);
  expectError<ValueError>([&] { b.bot.setCompliance(MatrixXd::Ones(2, 2)); }, {"linearly dependent"});
  expectError<ValueError>([&] { b.bot.setCompliance(row(1., 0.), 2.); }, {"compliance is 2"});
  expectError<ValueError>([&] { b.bot.setCompliance(MatrixXd::Ones(1, 3)); }, {"3 columns"});
}
