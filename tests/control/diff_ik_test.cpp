#include "kinegraph/control/diff_ik.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "kinegraph/common/random.h"
#include "kinegraph/features/eval.h"
#include "tests/control/arm.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

constexpr double kStep = .005;  // s
constexpr double kKept = 1e-9;  // by which a limit may be exceeded

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
  Config C = planarArm();
  DiffIk ik(C, withLimits(2., 0.));
  ik.addTask(FeatureSymbol::positionDiff, {"tip", "target"});
  for (int i = 0; i < 400; ++i) ik.step(kStep);
  EXPECT_LT(distanceTo(C, "target"), 1e-5);
  EXPECT_EQ(ik.status(), DiffIkStatus::solved);
}

TEST(DiffIk, LimitsHoldWhileATargetOutOfReachMoves) {
  Config C = planarArm();
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

TEST(DiffIk, AnArmThatATargetOutOfReachStretchesComesToRest) {
  const Vector3d direction = Vector3d(1., .3, 0.).normalized();
  for (const double velocity : {1., 10.}) {
    for (const double distance : {1.6, 5., 100.}) {
      Config C = planarArm();
      C.getFrame("obstacle").setContact(0);
      DiffIk ik(C, withLimits(velocity, 0.));
      ik.addTask(FeatureSymbol::position, {"tip"}, 1., 1., distance * direction);
      for (int i = 0; i < 3000; ++i) ik.step(kStep);
      EXPECT_LT(ik.velocity().lpNorm<Eigen::Infinity>(), 1e-2) << distance << ", " << velocity;
      EXPECT_LT((C.getFrame("tip").getPosition() - 1.5 * direction).norm(), 1e-3) << distance << ", " << velocity;
    }
  }
}

TEST(DiffIk, ATargetThatTremblesIsFollowedAsCloselyAsItTrembles) {
  constexpr double kTrembling = 1e-3;  // m
  Config C = planarArm();
  DiffIk ik(C, withLimits(10., 0.));
  const Vector3d start = C.getFrame("tip").getPosition();
  const int task = ik.addTask(FeatureSymbol::position, {"tip"}, 1., 1., start);
  Rng rng(1);
  double worst = 0.;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d still = start + Vector3d(0., .1 * std::sin(i * kStep), 0.);
    ik.setTarget(task, still + kTrembling * Vector3d(rng.uniform(-1., 1.), rng.uniform(-1., 1.), 0.));
    ik.step(kStep);
    worst = std::max(worst, (C.getFrame("tip").getPosition() - still).norm());
  }
  EXPECT_LT(worst, 3. * kTrembling);
}

TEST(DiffIk, AnArmThatRestedStretchedGoesOnFromAnotherPlace) {
  for (int rest = 40; rest < 140; rest += 4) {
    Config C = planarArm();
    C.getFrame("obstacle").setContact(0);
    const VectorXd home = C.getJointState();
    const Vector3d reachable = C.getFrame("target").getPosition();
    DiffIk ik(C, withLimits(2., 0.));
    const int task = ik.addTask(FeatureSymbol::position, {"tip"}, 1., 1., Vector3d(5., 1.5, 0.));
    for (int i = 0; i < rest; ++i) ik.step(.02);
    C.setJointState(home);
    ik.setTarget(task, reachable);
    for (int i = 0; i < 200; ++i) ik.step(.02);
    EXPECT_LT((C.getFrame("tip").getPosition() - reachable).norm(), 1e-3) << rest;
  }
}

/// The root mean square distance of a tip from a target that swings faster than limits allow, at 50 Hz.
double errorOfSwinging(bool is_damped) {
  Config C = planarArm();
  C.getFrame("obstacle").setContact(0);
  DiffIk ik(C, withLimits(1.5, 0.));
  const Vector3d start = C.getFrame("tip").getPosition();
  const int task = ik.addTask(FeatureSymbol::position, {"tip"}, 1., 1., start);
  double sum = 0.;
  for (int i = 0; i < 500; ++i) {
    const Vector3d target = start + Vector3d(0., .1 * std::sin(12.6 * .02 * i), 0.);
    ik.setTarget(task, target);
    if (!is_damped) ik.reset();
    ik.step(.02);
    sum += (C.getFrame("tip").getPosition() - target).squaredNorm();
  }
  return std::sqrt(sum / 500.);
}

TEST(DiffIk, TargetsThatSwingInReachAreFollowedAsWithoutDamping) {
  EXPECT_LT(errorOfSwinging(true), 1.1 * errorOfSwinging(false) + 1e-6);
}

TEST(DiffIk, PairsKeepTheirMargin) {
  Config C = planarArm();
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

TEST(DiffIk, FromBeyondALimitAJointReturnsAtItsSpeedLimit) {
  Config C = planarArm();
  DiffIk ik(C, withLimits(1., 0.));
  ik.addTask(FeatureSymbol::positionDiff, {"tip", "target"});
  C.setJointState(Eigen::Vector3d(.3, 2.1, .4));
  EXPECT_NEAR(ik.step(kStep)[1], -1., kKept);
  for (int i = 0; i < 40; ++i) ik.step(kStep);
  EXPECT_LE(C.getJointState()[1], 2. + kKept);
}

TEST(DiffIk, DampersThatContradictLimitsAreRelaxedAndNamed) {
  Config C = planarArm();
  DiffIk ik(C, withLimits(.1, 0.));
  ik.addTask(FeatureSymbol::positionDiff, {"tip", "target"});
  C.getFrame("obstacle").setPosition(C.getFrame("tip").getPosition() + Vector3d(.05, 0., 0.));
  const VectorXd velocity = ik.step(kStep);
  EXPECT_EQ(ik.status(), DiffIkStatus::constraints_relaxed);
  EXPECT_NE(ik.message().find("'tip' and 'obstacle' at -0.1 m by"), std::string::npos) << ik.message();
  EXPECT_LE(velocity.cwiseAbs().maxCoeff(), .1 + kKept);
  EXPECT_LT(eval(C, FeatureSymbol::positionDiff, {"tip", "obstacle"}).y[0], -.05);  // and it goes away
}

TEST(DiffIk, ThePostureDeterminesTheNullspace) {
  Config C = planarArm();
  DiffIkOptions options = withLimits(5., 0.);
  options.posture = 1e-2;
  DiffIk ik(C, options);
  const Eigen::Vector3d posture(.1, .2, .3);
  ik.setPosture(posture);
  for (int i = 0; i < 400; ++i) ik.step(kStep);
  EXPECT_LT((C.getJointState() - posture).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(DiffIk, ATaskOfAHigherPriorityNumberUsesFreeDirections) {
  Config C = planarArm();
  DiffIkOptions options = withLimits(1e4, 0.);
  options.posture = 1e-3;
  const Eigen::Vector3d q = C.getJointState(), wanted(1., -.5, .2);
  DiffIk ik(C, options);
  ik.addTask(FeatureSymbol::positionDiff, {"tip", "target"}, 1., .5);
  ik.addTask(FeatureSymbol::qItself, {}, 100., 1., wanted, 1);  // its weight does not matter to the first
  const VectorXd step = kStep * ik.step(kStep, false);

  // On paper: least |x - (wanted - q)|^2 subject to J x = -y / 2, by its conditions.
  MatrixXd J(2, 3);
  const Evaluation tip = eval(C, FeatureSymbol::positionDiff, {"tip", "target"});
  J = tip.J.topRows(2);
  MatrixXd conditions = MatrixXd::Zero(5, 5);
  conditions.topLeftCorner(3, 3).setIdentity();
  conditions.bottomLeftCorner(2, 3) = J, conditions.topRightCorner(3, 2) = J.transpose();
  VectorXd right(5);
  right << wanted - q, -.5 * tip.y.head(2);
  const VectorXd expected = conditions.fullPivLu().solve(right).head(3);
  EXPECT_LT((step - expected).norm(), 1e-6);
  EXPECT_LT((J * step + .5 * tip.y.head(2)).norm(), 1e-8);
}

TEST(DiffIk, PrioritiesKeepLimitsAndPairs) {
  Config C = planarArm();
  C.getFrame("obstacle").setPosition({.9, .8, 0.});  // at the target
  DiffIk ik(C, withLimits(2., 20.));
  ik.addTask(FeatureSymbol::positionDiff, {"tip", "target"});
  ik.addTask(FeatureSymbol::qItself, {}, 1., .02, Eigen::Vector3d(3., -2., 2.), 1);
  ik.addTask(FeatureSymbol::qItself, {"j1"}, 1., .02, VectorXd::Zero(1), 2);
  const MatrixXd limits = C.getJointLimits();
  for (int i = 0; i < 600; ++i) {
    const VectorXd velocity = ik.step(kStep), q = C.getJointState();
    EXPECT_LE(velocity.cwiseAbs().maxCoeff(), 2. + kKept);
    EXPECT_GE((q - limits.row(0).transpose()).minCoeff(), -kKept);
    EXPECT_GE((limits.row(1).transpose() - q).minCoeff(), -kKept);
    EXPECT_GT(distanceTo(C, "obstacle") - .15, .01 - 1e-4);
    EXPECT_EQ(ik.status(), DiffIkStatus::solved) << ik.message();
  }
  EXPECT_LT(distanceTo(C, "obstacle") - .15, .011);
}

TEST(DiffIk, EqualitiesHoldBesideTasks) {
  Config C = planarArm();
  C.getFrame("target").setPosition(C.getFrame("tip").getPosition());
  DiffIk ik(C, withLimits(1., 10.));
  ik.addTask(FeatureSymbol::qItself, {}, 100., .01, Eigen::Vector3d(-1., 1.5, 1.));
  ik.addEquality(FeatureSymbol::positionDiff, {"tip", "target"});
  const VectorXd before = C.getJointState();
  for (int i = 0; i < 300; ++i) {
    ik.step(kStep);
    EXPECT_EQ(ik.status(), DiffIkStatus::solved) << ik.message();
    EXPECT_LT(distanceTo(C, "target"), 1e-4);
  }
  EXPECT_GT((C.getJointState() - before).norm(), .2);  // within what is open
}

TEST(DiffIk, AnEqualityThatLimitsForbidIsRelaxedAndNamed) {
  Config C = planarArm();
  DiffIk ik(C, withLimits(.5, 0.));
  const int tip = ik.addEquality(FeatureSymbol::positionDiff, {"tip", "target"});
  C.getFrame("target").setPosition({5., 0., 0.});
  const VectorXd velocity = ik.step(kStep);
  EXPECT_LE(velocity.cwiseAbs().maxCoeff(), .5 + kKept);
  EXPECT_EQ(ik.status(), DiffIkStatus::constraints_relaxed);
  EXPECT_NE(ik.message().find("equality positionDiff"), std::string::npos) << ik.message();
  EXPECT_NE(ik.message().find("tip, target by "), std::string::npos) << ik.message();
  ik.setTarget(tip, eval(C, FeatureSymbol::positionDiff, {"tip", "target"}).y);
  ik.step(kStep);
  EXPECT_EQ(ik.status(), DiffIkStatus::solved) << ik.message();
}

TEST(DiffIk, MistakesAreNamed) {
  Config C = planarArm();
  expectError<ValueError>([&] { DiffIk(C, withLimits(-1., 0.)); }, {"velocity", "not positive"});
  DiffIk ik(C);
  expectError<ValueError>([&] { ik.addTask(FeatureSymbol::positionDiff, {"tip", "target"}, 1., 2.); }, {"gain is 2"});
  expectError<FrameNotFound>([&] { ik.addTask(FeatureSymbol::positionDiff, {"tip", "traget"}); }, {"traget", "target"});
  expectError<ValueError>([&] { ik.step(0.); }, {"dt is 0"});
}
