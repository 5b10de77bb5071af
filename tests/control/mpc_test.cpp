#include "kinegraph/control/mpc.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/komo/mode_switches.h"
#include "tests/control/arm.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

constexpr double kTau = .05;  // s per slice
constexpr MpcOptions kTight{.tolerance = 1e-7, .violation = 1e-7};

double tipTo(Config& C, const VectorXd& q, const Vector3d& place) {
  C.setJointState(q);
  return (C.getFrame("tip").getPosition() - place).norm();
}

/// A motion through the slices as if it had been solved from nothing.
MatrixXd solvedAnew(const Komo& komo, const VectorXd& q, const VectorXd& velocity) {
  Mpc mpc(komo, kTight);
  mpc.step(q, velocity);
  return mpc.getPath();
}

/// Follows its plan exactly, and calls `each` before every call.
template <class Each>
VectorXd follow(Mpc& mpc, VectorXd q, int calls, const Each& each) {
  VectorXd velocity = VectorXd::Zero(q.size());
  for (int i = 0; i < calls; ++i) {
    each(i, q);
    mpc.step(q, velocity);
    const VectorXd next = mpc.getPath().row(0);
    velocity = (next - q) / kTau;
    q = next;
  }
  return q;
}

}  // namespace

TEST(Mpc, WithoutWishesTheMotionGoesOnAsMeasured) {
  Komo komo(planarArm(), .5, 20, 2);
  komo.addControlObjective({}, 2, 1.);
  Mpc mpc(komo);
  const Eigen::Vector3d q(.1, -.2, .3), velocity(.5, 0., -1.);
  mpc.step(q, velocity);
  for (int t = 0; t < 10; ++t) {
    const VectorXd expected = q + (t + 1) * kTau * velocity;
    EXPECT_LT((mpc.getPath().row(t).transpose() - expected).norm(), 1e-9);
  }
  EXPECT_LT((mpc.at(.12).q - (q + .12 * velocity)).norm(), 1e-9);
  EXPECT_LT((mpc.at(.12).velocity - velocity).norm(), 1e-9);
  EXPECT_EQ(mpc.at(9.).velocity, VectorXd::Zero(3));
}

TEST(Mpc, TheHorizonIsTheMotionAsATrajectory) {
  Mpc mpc(reachingHorizon(planarArm()));
  const Eigen::Vector3d q(.1, -.2, .3), velocity(.5, 0., -1.);
  mpc.step(q, velocity);
  const HorizonTrajectory horizon = mpc.horizon();
  EXPECT_EQ(horizon.dimension(), 3);
  EXPECT_NEAR(horizon.duration(), mpc.komo().slices() * mpc.komo().tau(), 1e-12);
  EXPECT_EQ(horizon.eval(-1.).q, q);
  for (double t = .0071; t < horizon.duration(); t += .013) {
    const MotionState state = horizon.eval(t), before = horizon.eval(t - 1e-6), after = horizon.eval(t + 1e-6);
    EXPECT_EQ(state.q, mpc.at(t).q) << t;
    EXPECT_EQ(state.velocity, mpc.at(t).velocity) << t;
    EXPECT_LT((state.acceleration - (after.velocity - before.velocity) / 2e-6).norm(), 1e-4) << t;
  }
  const VectorXd last = mpc.getPath().bottomRows(1).transpose();
  EXPECT_LT((horizon.eval(horizon.duration()).q - last).norm(), 1e-12);
}

TEST(Mpc, WhatItKnowsLeadsToTheSameMotionAsStartingAnew) {
  Config C = planarArm();
  C.getFrame("obstacle").setPosition({.75, 1., 0.});
  const Komo komo = reachingHorizon(C);
  Mpc mpc(komo, kTight);
  int warm = 0, cold = 0;
  follow(mpc, C.getJointState(), 15, [&](int i, const VectorXd&) {
    if (i == 0) return;
    warm += mpc.result().evals;
  });
  const VectorXd q = mpc.getPath().row(0), velocity = (mpc.getPath().row(1).transpose() - q) / kTau;
  mpc.step(q, velocity);
  EXPECT_EQ(mpc.result().status, SolverStatus::converged) << mpc.result().message;
  EXPECT_LT((mpc.getPath() - solvedAnew(komo, q, velocity)).cwiseAbs().maxCoeff(), 1e-5);
  Mpc anew(komo, kTight);
  anew.step(q, velocity);
  cold = anew.result().evals;
  EXPECT_TRUE(anew.result().was_cold);
  EXPECT_LT(mpc.result().evals, cold);
  EXPECT_FALSE(mpc.result().was_cold);
}

TEST(Mpc, CalledAtAnotherRateThanThatOfItsSlicesItFindsTheSameMotion) {
  Config C = planarArm();
  const Komo komo = reachingHorizon(C);
  Mpc mpc(komo, kTight);
  VectorXd q = C.getJointState(), velocity = VectorXd::Zero(3);
  mpc.step(q, velocity);
  for (int i = 0; i < 20; ++i) {
    const MotionPoint now = mpc.at(.013);
    q = now.q, velocity = now.velocity;
    mpc.step(q, velocity, .013);
    if (i > 10) EXPECT_LE(mpc.result().evals, 8);
  }
  EXPECT_LT((mpc.getPath() - solvedAnew(komo, q, velocity)).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Mpc, ATargetSliceBySliceIsFollowedWithoutLag) {
  Config C = planarArm();
  const auto place = [](double t) -> Vector3d { return {.9 + .2 * std::cos(2. * t), .6 + .2 * std::sin(2. * t), 0.}; };
  double worst = 0., worst_of_one_pose = 0.;
  for (const bool sees_ahead : {true, false}) {
    Mpc following(reachingHorizon(C));
    follow(following, C.getJointState(), 60, [&](int i, const VectorXd& q) {
      MatrixXd poses(10, 3);
      for (int t = 0; t < 10; ++t) poses.row(t) = place((i + (sees_ahead ? t + 1 : 0)) * kTau).transpose();
      following.setPoses("target", sees_ahead ? poses : MatrixXd(poses.topRows(1)));
      double& most = sees_ahead ? worst : worst_of_one_pose;
      if (i > 20) most = std::max(most, tipTo(C, q, place(i * kTau)));
    });
  }
  EXPECT_LT(worst, 2e-3);
  EXPECT_GT(worst_of_one_pose, 10. * worst);
}

TEST(Mpc, OneStepACallStaysOutOfWhatComesAcross) {
  Config C = planarArm();
  Mpc mpc(reachingHorizon(C), {.evaluations = 2});
  const Vector3d target(.9, .8, 0.);
  const auto obstacle = [](double t) -> Vector3d { return {.9, 1.8 - .5 * t, 0.}; };  // through the target
  double least = 1., nearest = 1.;
  follow(mpc, C.getJointState(), 100, [&](int i, const VectorXd& q) {
    MatrixXd poses(10, 3);
    for (int t = 0; t < 10; ++t) poses.row(t) = obstacle((i + t + 1) * kTau).transpose();
    mpc.setPoses("obstacle", poses);
    least = std::min(least, tipTo(C, q, obstacle(i * kTau)) - .15);
    if (i > 80) nearest = std::min(nearest, tipTo(C, q, target));
    if (i > 1) EXPECT_LE(mpc.result().evals, 2);
  });
  EXPECT_GT(least, -1e-3);
  EXPECT_LT(least, .02);  // it was in the way
  EXPECT_LT(nearest, 2e-3);
}

TEST(Mpc, APushIsTakenUp) {
  Config C = planarArm();
  Mpc mpc(reachingHorizon(C));
  VectorXd q = follow(mpc, C.getJointState(), 30, [](int, const VectorXd&) {});
  q += Eigen::Vector3d(.2, -.1, .15);
  mpc.step(q, Eigen::Vector3d(1., -1., 0.));
  EXPECT_TRUE(mpc.result().feasible);
  EXPECT_LT((mpc.at(1e-4).q - q).norm(), 1e-3);
  q = follow(mpc, mpc.getPath().row(0), 30, [](int, const VectorXd&) {});
  EXPECT_LT(tipTo(C, q, {.9, .8, 0.}), 2e-3);
}

TEST(Mpc, ACallThatFailsDoesNotSpoilTheNext) {
  Config C = planarArm();
  Komo komo = reachingHorizon(C);
  komo.addObjective({.5}, FeatureSymbol::positionDiff, {"tip", "target"}, ObjectiveType::eq, 10.);
  Mpc mpc(komo, kTight);
  const VectorXd q = C.getJointState(), rest = VectorXd::Zero(3);
  mpc.step(q, rest);
  const MatrixXd before = mpc.getPath();
  mpc.setPoses("target", Eigen::RowVector3d(5., 0., 0.));  // out of reach
  mpc.step(q, rest, 0.);
  EXPECT_FALSE(mpc.result().feasible);
  EXPECT_GT(mpc.result().violation, 30.);
  expectError<ValueError>([&] { mpc.step(VectorXd::Constant(3, NAN), rest); }, {"q", "not finite"});
  mpc.setPoses("target", Eigen::RowVector3d(.9, .8, 0.));
  mpc.step(q, rest, 0.);
  EXPECT_EQ(mpc.result().status, SolverStatus::converged) << mpc.result().message;
  EXPECT_LT((mpc.getPath() - before).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Mpc, ABudgetOfTimeEndsACallAfterAStep) {
  Config C = planarArm();
  C.getFrame("obstacle").setPosition({.75, 1., 0.});
  Mpc mpc(reachingHorizon(C), {.microseconds = 1e-3, .tolerance = 1e-9});
  mpc.step(C.getJointState(), VectorXd::Zero(3));
  const int cold = mpc.result().evals;
  EXPECT_GT(cold, 2);  // the first call is not in the loop yet
  mpc.step(C.getJointState() + VectorXd::Constant(3, .3), VectorXd::Zero(3));
  EXPECT_EQ(mpc.result().evals, 2);
  EXPECT_EQ(mpc.result().status, SolverStatus::limit);
  EXPECT_EQ(mpc.result().message, "limit of 2 evaluations");
}

TEST(Mpc, ObjectivesOfTheLastSliceAreTerminal) {
  Config C = planarArm();
  Komo komo(C, .5, 20, 2);
  komo.addControlObjective({}, 2, .1);
  komo.addObjective({.5}, FeatureSymbol::positionDiff, {"tip", "target"}, ObjectiveType::eq, 10.);
  komo.addObjective({.5}, FeatureSymbol::qItself, {}, ObjectiveType::eq, 1., {}, 1);
  Mpc mpc(komo, kTight);
  follow(mpc, C.getJointState(), 8, [](int, const VectorXd&) {});
  const MatrixXd path = mpc.getPath();
  EXPECT_LT(tipTo(C, path.row(9), {.9, .8, 0.}), 1e-6);
  EXPECT_LT((path.row(9) - path.row(8)).norm(), 1e-7);
  EXPECT_GT((path.row(8) - path.row(7)).norm(), 1e-4);
}

TEST(Mpc, TargetsOfObjectivesMove) {
  const Config C = planarArm();
  const auto problem = [&](const Eigen::Vector3d& q) {
    Komo komo(C, .5, 20, 2);
    komo.addControlObjective({}, 2, .1);
    komo.addObjective({}, FeatureSymbol::qItself, {}, ObjectiveType::sos, {3., 2., 1.}, VectorXd(q));
    return komo;
  };
  const Eigen::Vector3d first(.1, .2, .3), second(-.5, 1., .7);
  Mpc mpc(problem(first), kTight);
  mpc.setTarget(1, second.transpose());
  mpc.step(C.getJointState(), VectorXd::Zero(3));
  EXPECT_LT((mpc.getPath() - solvedAnew(problem(second), C.getJointState(), VectorXd::Zero(3))).norm(), 1e-6);
  MatrixXd line(10, 3);
  for (int t = 0; t < 10; ++t) line.row(t) = second + .1 * (t + 1) * first;
  mpc.setTarget(1, line);
  mpc.step(second, 2. * first);
  EXPECT_LT((mpc.getPath() - line).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Mpc, RootObjectsAreTakenFromAScene) {
  Config C = planarArm();
  Mpc mpc(reachingHorizon(C), kTight);
  C.getFrame("target").setPosition({.5, 1.1, 0.});
  mpc.updateRootObjects(C);
  const VectorXd q = follow(mpc, C.getJointState(), 40, [](int, const VectorXd&) {});
  EXPECT_LT(tipTo(C, q, {.5, 1.1, 0.}), 2e-3);
}

TEST(Mpc, WhatHangsBelowAFrameMovesAlong) {
  Config C = planarArm();
  C.addFrame("goal", "target").setRelativePosition({0., -.3, 0.});
  Komo komo(C, .5, 20, 2);
  komo.addControlObjective({}, 2, .1);
  komo.addObjective({}, FeatureSymbol::positionDiff, {"tip", "goal"}, ObjectiveType::sos, 10.);
  Mpc mpc(komo);
  Eigen::Matrix<double, 1, 7> pose;
  pose << .5, .8, 0., std::sqrt(.5), 0., 0., std::sqrt(.5);  // a quarter turn about z: the goal lies at x + .3
  mpc.setPoses("target", pose);
  const VectorXd q = follow(mpc, C.getJointState(), 40, [](int, const VectorXd&) {});
  EXPECT_LT(tipTo(C, q, {.8, .8, 0.}), 2e-3);
}

TEST(Mpc, InAHorizonThatEndsModeSwitchesComeNearer) {
  Config C = planarArm();
  C.addFrame("box").setShape(ShapeType::sphere, {.02}).setPosition({.9, .8, 0.});
  Komo komo(C, 2., 10, 2);
  komo.addControlObjective({}, 2, .1);
  komo.addModeSwitch({1., 2.}, SwitchMode::stable, {"tip", "box"});
  komo.addObjective({1.}, FeatureSymbol::positionDiff, {"tip", "box"}, ObjectiveType::eq, 10.);
  const Vector3d goal(.3, 1.1, 0.);
  komo.addObjective({2.}, FeatureSymbol::position, {"box"}, ObjectiveType::eq, 10., VectorXd(goal));
  expectError<ValueError>([&] { Mpc mpc(komo); }, {"mode switches", "receding=false"});
  Mpc mpc(komo, {.receding = false});
  const double tau = mpc.komo().tau();
  VectorXd q = C.getJointState(), velocity = VectorXd::Zero(3);
  mpc.step(q, velocity, tau);
  const VectorXd planned = mpc.getPath().row(9);
  EXPECT_LT(tipTo(C, planned, {.9, .8, 0.}), 1e-4);
  VectorXd at_switch;
  for (int i = 1; i <= 20; ++i) {
    MotionPoint now = mpc.at(tau);
    if (i == 4 || i == 14) now.q += Eigen::Vector3d(.03, -.05, .04);  // pushes, before and after the switch
    q = now.q, velocity = now.velocity;
    if (i == 10) at_switch = q;
    mpc.step(q, velocity, tau);
    EXPECT_TRUE(mpc.result().feasible) << i << ": " << mpc.result().message;
    EXPECT_LT((mpc.getPath().row(i - 1).transpose() - q).norm(), 1e-9);  // what is over was as measured
  }
  EXPECT_LT(tipTo(C, at_switch, {.9, .8, 0.}), 1e-4);
  EXPECT_LT((mpc.komo().configuration(19).getFrame("box").getPosition() - goal).norm(), 1e-4);
  EXPECT_NEAR(mpc.elapsed(), 20. * tau, 1e-12);
  mpc.options.receding = true;
  expectError<ValueError>([&] { mpc.step(q, velocity, tau); }, {"mode switches", "receding=false"});
}

TEST(Mpc, MistakesAreNamed) {
  Config C = planarArm();
  const Komo komo = reachingHorizon(C);
  expectError<ValueError>([&] { Mpc(Komo(C, 1., 10, 0)); }, {"order 0", "order 1 or 2"});
  expectError<ValueError>([&] { Mpc(komo, {.evaluations = 1}); }, {"evaluations is 1", "at least 2"});
  Komo free(C, 1., 10, 2);
  free.addFreeMotion();
  expectError<ValueError>([&] { Mpc mpc(free); }, {"addFreeMotion", "accumulatedCollisions"});
  Mpc mpc(komo);
  expectError<FrameNotFound>([&] { mpc.setPoses("traget", MatrixXd::Zero(1, 3)); }, {"traget", "target"});
  expectError<ValueError>([&] { mpc.setPoses("tip", MatrixXd::Zero(1, 3)); }, {"tip", "which joints move"});
  expectError<ValueError>([&] { mpc.setPoses("base", MatrixXd::Zero(1, 3)); }, {"base", "carries the joint of 'j1'"});
  expectError<ValueError>([&] { mpc.setPoses("target", MatrixXd::Zero(3, 3)); }, {"(3, 3)", "(10, 7)"});
  expectError<ValueError>([&] { mpc.setPoses("target", MatrixXd::Zero(1, 7)); }, {"quaternion", "zero"});
  expectError<ValueError>([&] { mpc.setTarget(7, MatrixXd::Zero(1, 3)); }, {"no objective 7", "has 4"});
  expectError<ValueError>([&] { mpc.setTarget(3, MatrixXd::Zero(1, 2)); }, {"positionDiff", "(1, 2)", "(10, 3)"});
  expectError<ValueError>([&] { mpc.step(VectorXd::Zero(2), VectorXd::Zero(3)); }, {"q has 2", "3 dofs"});
}
