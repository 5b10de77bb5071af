#include "kinegraph/control/diff_ik.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

constexpr double kStep = .005;  // s
constexpr double kKept = 1e-9;  // by which a limit may be exceeded

/// Three joints in a plane, of 0.5 m each, a ball at the tip, and a target.
Config arm() {
  Config C;
  C.addText(R"scene(
base: { }
j1 (base): { joint: hingeZ, limits: [-3 3], q: .3 }
j2 (j1): { pre: "t(.5 0 0)", joint: hingeZ, limits: [-2 2], q: .4 }
j3 (j2): { pre: "t(.5 0 0)", joint: hingeZ, limits: [-2 2], q: .4 }
tip (j3): { Q: "t(.5 0 0)", shape: sphere, size: [.05], contact: 1 }
obstacle: { X: "t(5 0 0)", shape: sphere, size: [.1], contact: 1 }
target: { X: "t(.9 .8 0)" }
)scene");
  return C;
}

DiffIkOptions withLimits(double velocity, double acceleration) {
  DiffIkOptions options;
  options.velocity = VectorXd::Constant(3, velocity);
  if (acceleration > 0.) options.acceleration = VectorXd::Constant(3, acceleration);
  return options;
}

double distanceTo(const Config& C, const char* target) {
  return eval(C, FeatureSymbol::positionDiff, {"tip", target}).y.norm();
}

}  // namespace

TEST(DiffIk, AFrameComesToItsTarget) {
  Config C = arm();
  DiffIk ik(C, withLimits(2., 0.));
  ik.addTask(FeatureSymbol::positionDiff, {"tip", "target"});
  for (int i = 0; i < 400; ++i) ik.step(kStep);
  EXPECT_LT(distanceTo(C, "target"), 1e-5);
  EXPECT_EQ(ik.status(), DiffIkStatus::solved);
}

TEST(DiffIk, LimitsHoldWhileATargetOutOfReachMoves) {
  Config C = arm();
  DiffIk ik(C, withLimits(1., 5.));
  ik.addTask(FeatureSymbol::positionDiff, {"tip", "target"});
  const MatrixXd limits = C.getJointLimits();
  VectorXd before = VectorXd::Zero(3), q = C.getJointState();
  for (int i = 0; i < 3000; ++i) {
    const double t = i * kStep;
    C.getFrame("target").setPosition({2. * std::cos(t), 2. * std::sin(1.7 * t), 0.});
    const VectorXd velocity = ik.step(kStep);
    EXPECT_LE(velocity.cwiseAbs().maxCoeff(), 1. + kKept);
    EXPECT_LE((velocity - before).cwiseAbs().maxCoeff(), 5. * kStep + kKept);
    q = C.getJointState();
    EXPECT_GE((q - limits.row(0).transpose()).minCoeff(), -kKept);
    EXPECT_GE((limits.row(1).transpose() - q).minCoeff(), -kKept);
    EXPECT_EQ(ik.status(), DiffIkStatus::solved) << ik.message();
    before = velocity;
  }
}

TEST(DiffIk, PairsKeepTheirMargin) {
  Config C = arm();
  C.getFrame("obstacle").setPosition(C.getFrame("target").getPosition());  // the target is within
  DiffIk ik(C, withLimits(2., 0.));
  ik.addTask(FeatureSymbol::positionDiff, {"tip", "target"});
  for (int i = 0; i < 600; ++i) {
    ik.step(kStep);
    EXPECT_GT(distanceTo(C, "obstacle") - .15, .01 - 1e-4);  // the linearization leaves this
  }
  EXPECT_LT(distanceTo(C, "obstacle") - .15, .011);
  ASSERT_EQ(ik.active().size(), 1u);
  EXPECT_NE(ik.active()[0].find("'tip' and 'obstacle'"), std::string::npos) << ik.active()[0];
}

TEST(DiffIk, FromBeyondALimitItGoesBackAsFastAsItMay) {
  Config C = arm();
  DiffIk ik(C, withLimits(1., 0.));
  ik.addTask(FeatureSymbol::positionDiff, {"tip", "target"});
  C.setJointState(Eigen::Vector3d(.3, 2.1, .4));
  EXPECT_NEAR(ik.step(kStep)[1], -1., kKept);
  for (int i = 0; i < 40; ++i) ik.step(kStep);
  EXPECT_LE(C.getJointState()[1], 2. + kKept);
}

TEST(DiffIk, DampersThatContradictLimitsGiveWayAndAreNamed) {
  Config C = arm();
  DiffIk ik(C, withLimits(.1, 0.));
  ik.addTask(FeatureSymbol::positionDiff, {"tip", "target"});
  C.getFrame("obstacle").setPosition(C.getFrame("tip").getPosition() + Vector3d(.05, 0., 0.));
  const VectorXd velocity = ik.step(kStep);
  EXPECT_EQ(ik.status(), DiffIkStatus::gave_way);
  EXPECT_NE(ik.message().find("'tip' and 'obstacle' at -0.1 m by"), std::string::npos) << ik.message();
  EXPECT_LE(velocity.cwiseAbs().maxCoeff(), .1 + kKept);
  EXPECT_LT(eval(C, FeatureSymbol::positionDiff, {"tip", "obstacle"}).y[0], -.05);  // and it goes away
}

TEST(DiffIk, ThePostureDecidesWhatTasksLeaveOpen) {
  Config C = arm();
  DiffIkOptions options = withLimits(5., 0.);
  options.posture = 1e-2;
  DiffIk ik(C, options);
  const Eigen::Vector3d posture(.1, .2, .3);
  ik.setPosture(posture);
  for (int i = 0; i < 400; ++i) ik.step(kStep);
  EXPECT_LT((C.getJointState() - posture).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(DiffIk, MistakesAreNamed) {
  Config C = arm();
  expectError<ValueError>([&] { DiffIk(C, withLimits(-1., 0.)); }, {"velocity", "not positive"});
  DiffIk ik(C);
  expectError<ValueError>([&] { ik.addTask(FeatureSymbol::positionDiff, {"tip", "target"}, 1., 2.); }, {"gain is 2"});
  expectError<FrameNotFound>([&] { ik.addTask(FeatureSymbol::positionDiff, {"tip", "traget"}); }, {"traget", "target"});
  expectError<ValueError>([&] { ik.step(0.); }, {"dt is 0"});
}
