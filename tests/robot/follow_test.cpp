#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/robot/bot_op.h"
#include "kinegraph/robot/drivers.h"
#include "kinegraph/trajectories/retime.h"
#include "kinegraph/trajectories/trajectory.h"
#include "tests/robot/arm.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

struct FollowBench {
  Config C = twoJointArm();
  BotOp bot{C, std::make_shared<KinematicDriver>(C)};

  double now() const { return .01 * double(bot.getLog().ticks); }

  void stepOnce() { bot.sync(C, .01); }
};

VectorXd each(double value) { return VectorXd::Constant(2, value); }

/// From (0, 0) around a corner to (.4, .9), with accelerations that jump.
TimedPath corner() {
  MatrixXd path(3, 2);
  path << 0., 0., .8, .3, .4, .9;
  return retime(path, {each(1.5), each(4.), {}}, {.tolerance = .05});
}

/// q = start + velocity t for one second.
class Line final : public Trajectory {
 public:
  Line(VectorXd start, VectorXd velocity) : start_(std::move(start)), velocity_(std::move(velocity)) {}
  int dimension() const override { return int(start_.size()); }
  double duration() const override { return 1.; }
  void evalTo(double t, double* q, double* velocity, double* acceleration) const override {
    t = std::clamp(t, 0., 1.);
    for (Eigen::Index i = 0; i < start_.size(); ++i)
      q[i] = start_[i] + t * velocity_[i], velocity[i] = velocity_[i], acceleration[i] = 0.;
  }

 private:
  VectorXd start_, velocity_;
};

/// The robot is at the trajectory's state, `begin` s after the start of control time, at each period until `end`.
void expectFollows(FollowBench& b, const Trajectory& motion, double begin, double end) {
  while (b.now() < end - 1e-9) {
    b.stepOnce();
    const double t = b.now() - begin;
    const MotionState state = motion.eval(t);
    const StepObservation robot = b.bot.stepObservation();
    EXPECT_LT((robot.qpos - state.q).norm(), 1e-12) << t;
    if (t < motion.duration()) EXPECT_LT((robot.qvel - state.velocity).norm(), 1e-12) << t;
    EXPECT_LT((b.C.getJointState() - state.q).norm(), 1e-12) << t;
  }
}

}  // namespace

TEST(Follow, TheReferenceOfEachPeriodIsTheStateOfTheTrajectory) {
  const auto driver = std::make_shared<RecordedDriver>(plainRobot(), std::vector<RobotState>(), pair(0., 0.));
  Config C = twoJointArm();
  BotOp bot(C, driver);
  const TimedPath motion = corner();
  bot.sync(C, .05);
  bot.follow(motion);
  EXPECT_NEAR(bot.getTimeToEnd(), motion.duration(), 1e-12);
  bot.wait(C);
  const auto& commands = driver->commands();
  const auto count = std::size_t(motion.duration() / .01);
  ASSERT_GT(commands.size(), count + 5);
  for (std::size_t k = 1; k <= count; ++k) {
    const MotionState state = motion.eval(double(k) * .01);
    EXPECT_EQ(commands[4 + k].q, state.q) << k;  // to the bit
    EXPECT_EQ(commands[4 + k].velocity, state.velocity) << k;
    EXPECT_EQ(commands[4 + k].acceleration, state.acceleration) << k;
  }
  EXPECT_EQ(commands.back().q, motion.eval(motion.duration()).q);
  EXPECT_EQ(commands.back().velocity, pair(0., 0.));
  EXPECT_EQ(commands.back().acceleration, pair(0., 0.));
}

TEST(Follow, ARobotFollowsAnyTrajectoryAndRestsAtItsEnd) {
  MatrixXd points(4, 2);
  points << 0., 0., .3, -.2, .1, .4, .6, .2;
  const SplineTrajectory spline(BSpline(3, points, Eigen::Vector4d(1., 1.5, 2., 3.)));
  const TimedPath timed = corner();
  for (const Trajectory* motion : {static_cast<const Trajectory*>(&spline), static_cast<const Trajectory*>(&timed)}) {
    FollowBench b;
    b.bot.follow(*motion);
    expectFollows(b, *motion, 0., motion->duration() + .1);
    EXPECT_LE(b.bot.getTimeToEnd(), 0.);
    EXPECT_LT(b.bot.get_qDot().norm(), 1e-12);
    EXPECT_EQ(b.bot.getMode(), LoopMode::follow);
  }
}

TEST(Follow, StartsAfterThePresentMotionOrInsteadOfIt) {
  const TimedPath motion = corner();
  FollowBench b;
  b.bot.follow(motion);
  MatrixXd back(2, 2);
  back << .4, .9, 0., 0.;
  const TimedPath other = retime(back, {each(1.), each(3.), {}});
  b.bot.follow(other);
  const double begin = motion.duration();
  EXPECT_NEAR(b.bot.getTimeToEnd(), begin + other.duration(), 1e-9);
  expectFollows(b, motion, 0., begin - .01);
  expectFollows(b, other, begin, begin + .5 * other.duration());
  // A trajectory from the present state takes over without a jump.
  const double now = b.now();
  MatrixXd rest(2, 2);
  rest << other.eval(now - begin).q.transpose(), other.eval(now - begin).q.transpose() - row(.1, .225);
  RetimeOptions options;
  options.start_velocity = other.eval(now - begin).velocity;
  const TimedPath takes_over = retime(rest, {each(1.), each(2.9), {}}, options);
  ASSERT_TRUE(takes_over.feasible()) << takes_over.message;
  b.bot.follow(takes_over, {.overwrite = true});
  expectFollows(b, takes_over, now, now + takes_over.duration() + .05);

  FollowBench c;  // the same from a later time on, between two control periods
  c.bot.follow(motion);
  const double later = .2537;
  options.start_velocity = motion.eval(later).velocity;
  rest << motion.eval(later).q.transpose(), motion.eval(later).q.transpose() + .3 * options.start_velocity.transpose();
  const TimedPath second = retime(rest, {each(1.5), each(4.), {}}, options);
  ASSERT_TRUE(second.feasible()) << second.message;
  c.bot.follow(second, {.overwrite = true, .start_time = later});
  EXPECT_NEAR(c.bot.getTimeToEnd(), later + second.duration(), 1e-9);
  expectFollows(c, motion, 0., .25);
  expectFollows(c, second, later, later + second.duration() + .05);
  expectError<ValueError>([&] { c.bot.follow(second, {.overwrite = true, .start_time = .1}); },
                          {"start_time is 0.1 s"});
}

TEST(Follow, LaterMotionsAreAppendedOrReplaceIt) {
  const TimedPath motion = corner();
  FollowBench b;
  b.bot.follow(motion);
  b.bot.move(row(.4, .5), seconds(1.));
  EXPECT_NEAR(b.bot.getTimeToEnd(), motion.duration() + 1., 1e-9);
  b.bot.moveTo(pair(.2, .2));
  const double ends = motion.duration() + 1. + std::sqrt(6. * std::hypot(.2, .3));
  EXPECT_NEAR(b.bot.getTimeToEnd(), ends - .01, 1e-9);  // the second query
  expectFollows(b, motion, 0., .01 * std::floor(motion.duration() / .01));
  b.bot.sync(b.C, 1. + 1e-9);
  EXPECT_LT((b.bot.get_q() - pair(.4, .5)).norm(), 1e-3);
  b.bot.wait(b.C);
  EXPECT_LT((b.bot.get_q() - pair(.2, .2)).norm(), 1e-12);

  FollowBench c;
  c.bot.follow(motion);
  const double cut = .505;
  c.bot.move(row(0., 0.), seconds(1.), true, cut);
  EXPECT_NEAR(c.bot.getTimeToEnd(), cut + 1., 1e-9);
  expectFollows(c, motion, 0., .5);
  const MatrixXd points = (MatrixXd(2, 2) << motion.eval(cut).q.transpose(), row(0., 0.)).finished();
  const BSpline after(3, points, pair(cut, cut + 1.), motion.eval(cut).velocity);
  while (c.now() < cut + 1.) {
    c.stepOnce();
    EXPECT_LT((c.bot.stepObservation().qref - after.eval(c.now())).norm(), 1e-3)
        << c.now();  // the acceleration jumps near the cut
  }

  FollowBench d;
  d.bot.follow(motion);
  d.bot.sync(d.C, .4);
  const VectorXd velocity = d.bot.get_qDot();
  d.bot.move(row(0., 0.), seconds(1.5), true);
  d.stepOnce();
  EXPECT_LT((d.bot.get_qDot() - velocity).norm(), .1);
  d.bot.wait(d.C);
  EXPECT_LT(d.bot.get_q().norm(), 1e-12);
  d.bot.follow(motion);
  d.bot.sync(d.C, .4);
  d.bot.stop(d.C);
  EXPECT_EQ(d.bot.getMode(), LoopMode::hold);
  EXPECT_LT(d.bot.get_qDot().norm(), 1e-12);
}

TEST(Follow, ATrajectoryThatEndsInMotionIsFollowedByAStop) {
  FollowBench b;
  b.bot.setLimits({}, each(5.), {});
  const Line line(pair(0., 0.), pair(.5, -.2));
  expectError<ValueError>([&] { b.bot.follow(line); }, {"joint 'arm1' at a velocity of 0.5 /s, the robot's is 0 /s"});
  b.bot.follow(line, {.velocity_tolerance = .6});
  EXPECT_LE(b.bot.getTimeToEnd(), 1. + 1e-9);  // the tolerance counts at the end, too
  FollowBench c;
  c.bot.setLimits({}, each(5.), {});
  const BSpline run_up(3, (MatrixXd(2, 2) << -.25, .1, 0., 0.).finished(), pair(0., 1.), {}, pair(.5, -.2));
  c.bot.moveTo(pair(-.25, .1));
  c.bot.wait(c.C);
  const double begin = c.now();
  c.bot.follow(SplineTrajectory(run_up));
  c.bot.sync(c.C, .99);
  EXPECT_GT(c.bot.get_qDot().norm(), .4);
  const MotionState running = SplineTrajectory(run_up).eval(.99);
  c.bot.follow(Line(running.q, running.velocity), {.overwrite = true});
  EXPECT_GT(c.bot.getTimeToEnd(), 1.05);
  c.bot.sync(c.C, .9);
  EXPECT_NEAR(c.bot.get_qDot()[0], running.velocity[0], 1e-9);
  VectorXd last = c.bot.get_qDot();
  while (c.bot.getTimeToEnd() > 0.) {
    c.stepOnce();
    EXPECT_LE((c.bot.stepObservation().qvel - last).cwiseAbs().maxCoeff(), 5. * .01 + 1e-9);
    last = c.bot.stepObservation().qvel;
  }
  EXPECT_GT(c.now() - begin, 2.);
  c.bot.sync(c.C, .05);
  EXPECT_LT(c.bot.get_qDot().norm(), 1e-12);
}

TEST(Follow, RefusesATrajectoryThatStartsElsewhereOrBreaksALimit) {
  FollowBench b;
  const auto refused = [&](const Trajectory& motion, std::initializer_list<const char*> parts) {
    expectError<ValueError>([&] { b.bot.follow(motion); }, parts);
  };
  const auto to = [](const VectorXd& from, const VectorXd& goal, double velocity) {
    MatrixXd path(2, from.size());
    path << from.transpose(), goal.transpose();
    return retime(path, {VectorXd::Constant(from.size(), velocity), VectorXd::Constant(from.size(), 10.), {}});
  };
  refused(to(pair(0., .01), pair(.5, .5), 1.), {"BotOp::follow", "starts with joint 'arm2' at 0.01, the robot is at 0",
                                                "tolerance is 0.001", "plan from the robot's q"});
  refused(to(pair(0., .2), pair(.5, .5), 1.), {"'arm2'"});
  refused(to(VectorXd::Zero(3), VectorXd::Ones(3), 1.), {"the trajectory has 3 dofs; the robot has 2 joints"});
  refused(to(pair(0., 0.), pair(1., .5), 3.),
          {"'arm1' would have a velocity of ", "its limit is 2 /s", "take at least 1."});
  refused(to(pair(0., 0.), pair(2.5, .5), 1.), {"'arm1' would go to 2.5; its limits are -2 to 2"});
  refused(TimedPath(), {"the trajectory has 0 dofs"});
  b.bot.setLimits({}, seconds(2.), {});
  refused(to(pair(0., 0.), pair(1., .5), 1.),
          {"an acceleration of 10 /s^2", "its limit is 2 /s^2", "take at least 2.23"});
  EXPECT_TRUE(b.bot.getLog().entries.empty());
  expectError<ValueError>([&] { b.bot.follow(corner(), {.tolerance = -1.}); }, {"tolerance is -1"});
  b.bot.setLimits({}, seconds(20.), {});
  b.bot.follow(to(pair(0., .01), pair(.5, .5), 1.), {.tolerance = .02});
  b.bot.wait(b.C);
  EXPECT_LT((b.bot.get_q() - pair(.5, .5)).norm(), 1e-12);
}

TEST(Follow, ALogOfItGivesTheSameMotionToTheBit) {
  FollowBench one, again;
  const auto script = [](FollowBench& b) {
    b.bot.follow(corner());
    b.bot.move(row(.2, 0.), seconds(1.));
    b.bot.sync(b.C, .7);
    b.bot.move(row(.1, .1), seconds(1.), true, .805);
    b.bot.wait(b.C);
  };
  script(one);
  const CommandLog log = one.bot.getLog();
  again.bot.replay(CommandLog::fromText(log.text()));
  EXPECT_EQ(again.bot.getLog().text(), log.text());
  EXPECT_EQ(again.bot.get_q(), one.bot.get_q());
  expectError<ParseError>(
      [] { CommandLog::fromText("kinegraph commands 1\nperiod 0.01\n0 trajectory 0 1 5 1 1 0 1 1 0 1 1 0\n"); },
      {"the first time is 5 s"});
}

TEST(Follow, ASimulatedRobotTracksTheTrajectory) {
  Config C = twoJointArm();
  C.getFrame("box").setPosition({0., 0., 1.});  // out of reach
  BotOp bot(C, std::make_shared<SimulatedDriver>(C));
  const TimedPath motion = corner();
  bot.follow(motion);
  for (double t = .01; t < motion.duration(); t += .01) {
    bot.sync(C, .01);
    EXPECT_LT((C.getJointState() - motion.eval(t).q).norm(), 2e-3) << t;
  }
}
