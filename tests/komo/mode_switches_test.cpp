#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "kinegraph/common/errors.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/objective_list.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/solvers/methods/augmented_lagrangian.h"

using namespace kinegraph;

namespace {

Config armAndBox() {
  Config config;
  config.addText(R"(
    world: {}
    table (world): { Q: [0, 0, .5], joint: rigid, shape: ssBox, size: [1.6, 1.2, .1, .01], contact: 1 }
    base (table): { Q: [-.3, 0, .05] }
    l1 (base): { joint: hingeZ, q: .3, limits: [-2, 2] }
    l1b (l1): { Q: [0, 0, .3] }
    l2 (l1b): { joint: hingeY, q: .4, limits: [-2, 2], ctrl_H: 2. }
    grip (l2): { Q: [.5, 0, 0], shape: ssBox, size: [.1, .08, .06, .01] }
    fixed (table): { Q: [.2, -.3, .1], shape: ssBox, size: [.1, .1, .1, .01] }
  )");
  config.addFrame("box")
      .setShape(ShapeType::ssBox, {.12, .1, .16, .01})
      .setPose({Vector3d(.3, .2, .63), unitQuaternion({.9, .1, -.2, .3})});
  config.addFrame("handle", "box").setRelativePosition({0., 0., .1});
  return config;
}

/// Largest relative difference between the Jacobian and central differences at three random points.
double jacobianError(Nlp& nlp, const Komo& komo, std::string& where) {
  Rng rng(7);
  double worst = 0.;
  for (int sample = 0; sample < 3; ++sample) {
    VectorXd x = komo.path().variables();
    for (double& value : x) value += .1 * rng.normal();
    const JacobianCheck check = checkJacobian(nlp, x);
    if (check.error <= worst) continue;
    worst = check.error;
    where = nlp.rowName(check.row) + ", column " + std::to_string(check.column);
  }
  return worst;
}

}  // namespace

TEST(ModeSwitches, JacobiansOfEveryKindEqualCentralDifferences) {
  const std::vector<std::pair<SwitchMode, std::string>> kinds = {
      {SwitchMode::stable, "grip"},     {SwitchMode::stableOn, "table"},  {SwitchMode::stableOnX, "table"},
      {SwitchMode::stableOnY, "table"}, {SwitchMode::stableYPhi, "grip"}, {SwitchMode::stableZero, "grip"},
      {SwitchMode::dynamic, "grip"},    {SwitchMode::dynamicOn, "table"}};
  for (const auto& [mode, parent] : kinds) {
    for (const std::string object : {"box", "handle"}) {
      auto komo = std::make_shared<Komo>(armAndBox(), 3., 2, 2);
      komo->addModeSwitch({1., 2.}, mode, {parent, object});
      komo->addModeSwitch({2., -1.}, SwitchMode::stable, {"l2", object});
      komo->addQuaternionNorms();
      komo->addControlObjective({}, 2);
      komo->addObjective({}, FeatureSymbol::jointLimits, {}, ObjectiveType::ineq);
      komo->addObjective({}, FeatureSymbol::poseDiff, {"box", "grip"}, ObjectiveType::sos);
      komo->addObjective({}, FeatureSymbol::poseRel, {"grip", "handle"}, ObjectiveType::sos, {}, {}, 1);
      komo->addObjective({}, FeatureSymbol::linangVel, {"box"}, ObjectiveType::sos, {}, {}, 2);
      std::string where;
      EXPECT_LT(jacobianError(*makeNlp(komo), *komo, where), 2e-6)
          << switchModeName(mode) << " of " << object << ": " << where;
    }
  }
}

TEST(ModeSwitches, JacobiansOfAddedFramesEqualCentralDifferences) {
  for (bool stable : {true, false}) {
    auto komo = std::make_shared<Komo>(armAndBox(), 2., 3, 2);
    komo->addFrameDof("grasp", "grip", JointType::free, stable, "box");
    komo->addFrameDof("spot", "table", JointType::transXYPhi, stable);
    komo->addFrameDof("knob", "grip", JointType::hingeX, stable);
    komo->addRigidSwitch(1., "grasp", "box");
    komo->addRigidSwitch(1.6, "spot", "box");
    komo->addQuaternionNorms();
    komo->addObjective({}, FeatureSymbol::poseDiff, {"box", "knob"}, ObjectiveType::sos);
    std::string where;
    EXPECT_LT(jacobianError(*makeNlp(komo), *komo, where), 2e-6) << stable << ": " << where;
  }
}

TEST(ModeSwitches, AFlyingBodyFallsWithGravity) {
  auto komo = std::make_shared<Komo>(armAndBox(), 2., 10, 2);
  komo->addModeSwitch({.5, -1.}, SwitchMode::dynamic, {"world", "box"});
  const auto nlp = makeNlp(komo);
  const double tau = komo->tau();
  VectorXd x = komo->path().variables();
  const auto column = [&](int slice, int i) {
    return komo->path().layout().column[slice + 2][2 + i];
  };  // after two hinges
  const Vector3d start(.3, .2, .63), velocity(1., -.5, 2.);
  for (int slice = 4; slice < 20; ++slice) {
    const double t = (slice - 4) * tau;
    // backward differences: a parabola with v_t - v_{t-1} = -g tau
    const Vector3d p = start + velocity * t - Vector3d(0., 0., .5 * 9.81 * t * t);
    for (int i = 0; i < 3; ++i) x[column(slice, i)] = p[i];
  }
  nlp->evaluate(x, *std::make_unique<VectorXd>(VectorXd::Zero(Eigen::Index(nlp->types().size()))), nullptr);
  const PathErrors errors = measurePath(*komo);
  for (std::size_t o = 0; o < komo->objectives().size(); ++o) {
    if (komo->objectives()[o].name() != "physics") continue;
    EXPECT_LT(errors.per_slice.col(Eigen::Index(o)).tail(14).maxCoeff(), 1e-9);
    EXPECT_EQ(komo->objectives()[o].from, 5);
    return;
  }
  FAIL() << "there is no objective on the flight";
}

TEST(ModeSwitches, WhatIsFixedToALargerTreeCanBeSwitched) {
  Komo komo(armAndBox(), 2., 1, 1);
  komo.addModeSwitch({1., -1.}, SwitchMode::stable, {"grip", "fixed"});
  EXPECT_EQ(komo.configuration(0).getFrame("fixed").getParent()->getName(), "grip");
  EXPECT_EQ(komo.configuration(-1).getFrame("fixed").getParent()->getName(), "table");
  const Pose before = komo.configuration(-1).getFrame("fixed").getPose(),
             after = komo.configuration(1).getFrame("fixed").getPose();
  EXPECT_LT((before.p - after.p).norm(), 1e-12);
}

TEST(ModeSwitches, AHandleTakesItsObjectAlong) {
  Komo komo(armAndBox(), 2., 1, 1);
  komo.addModeSwitch({1., -1.}, SwitchMode::stableZero, {"grip", "handle"});
  const Config held = komo.configuration(1);
  const Pose grip = held.getFrame("grip").getPose();
  EXPECT_LT((held.getFrame("handle").getPose().p - grip.p).norm(), 1e-12);
  EXPECT_LT((held.getFrame("box").getPose().p - (grip * Pose(Vector3d(0., 0., -.1), Quaterniond::Identity())).p).norm(),
            1e-12);
}

TEST(ModeSwitches, JointFeaturesUseTheInitialJointsAfterModeSwitches) {
  auto komo = std::make_shared<Komo>(armAndBox(), 2., 1, 1);
  komo->addModeSwitch({1., -1.}, SwitchMode::stable, {"grip", "box"});
  komo->addObjective({}, FeatureSymbol::qItself, {}, ObjectiveType::sos, {}, VectorXd::Zero(2));
  const auto nlp = makeNlp(komo);
  EXPECT_EQ(nlp->dimension(), 2 + 7 + 2);
  EXPECT_EQ(std::count(nlp->types().begin(), nlp->types().end(), ObjectiveType::sos), 4);
}

TEST(ModeSwitches, MistakesAreExplained) {
  Komo komo(armAndBox(), 2., 2, 1);
  EXPECT_THROW(komo.addModeSwitch({1., -1.}, SwitchMode::stable, {"grip", "bix"}), FrameNotFound);
  EXPECT_THROW(komo.addModeSwitch({1., -1.}, SwitchMode::stable, {"grip"}), ValueError);
  EXPECT_THROW(komo.addModeSwitch({1., -1.}, SwitchMode::quasiStaticOn, {"l1b", "box"}), ValueError);
  EXPECT_THROW(komo.addModeSwitch({1., -1.}, SwitchMode::touch, {"grip", "box"}), ValueError);
  EXPECT_THROW(komo.addModeSwitch({1., -1.}, SwitchMode::stableOn, {"l1b", "box"}), ValueError);
  EXPECT_THROW(komo.addModeSwitch({2., 1.}, SwitchMode::stable, {"grip", "box"}), ValueError);
  EXPECT_THROW(komo.addModeSwitch({1., -1.}, SwitchMode::stable, {"handle", "box"}), ValueError);
  EXPECT_THROW(komo.addFrameDof("box", "grip", JointType::free, true), ValueError);
  EXPECT_THROW(komo.addFrameDof("new", "gripp", JointType::free, true), FrameNotFound);
  EXPECT_THROW(Komo(armAndBox(), 1., 1, 0).addModeSwitch({1., -1.}, SwitchMode::stable, {"grip", "box"}), ValueError);
  EXPECT_TRUE(komo.objectives().empty());
  EXPECT_EQ(komo.path().layout().dimension, 8);
  komo.addModeSwitch({4., -1.}, SwitchMode::stable, {"grip", "box"});
  EXPECT_EQ(komo.takeWarnings().size(), 1u);
}

TEST(ModeSwitches, AnNlpMadeBeforeAChangeOfTheStructureSaysSo) {
  auto komo = std::make_shared<Komo>(armAndBox(), 2., 1, 1);
  komo->addControlObjective({}, 1);
  const auto nlp = makeNlp(komo);
  const VectorXd x = komo->path().variables();
  komo->addModeSwitch({1., -1.}, SwitchMode::stable, {"grip", "box"});
  VectorXd phi(Eigen::Index(nlp->types().size()));
  EXPECT_THROW(nlp->evaluate(x, phi, nullptr), Error);
}

TEST(ModeSwitches, MovedObjectsAreTakenOverInEveryMode) {
  Config config = armAndBox();
  auto komo = std::make_shared<Komo>(config, 3., 1, 1);
  komo->addModeSwitch({2., -1.}, SwitchMode::stable, {"grip", "box"});
  komo->setConstantPath(Eigen::Vector2d(.1, .2));
  config.getFrame("box").setPosition({.5, .1, .7});
  config.getFrame("table").setPosition({.1, 0., .5});
  komo->updateRootObjects(config);
  EXPECT_LT((komo->configuration(0).getFrame("box").getPose().p - Vector3d(.5, .1, .7)).norm(), 1e-12);
  for (int slice = -1; slice < 3; ++slice) {
    EXPECT_LT((komo->configuration(slice).getFrame("table").getPose().p - Vector3d(.1, 0., .5)).norm(), 1e-12) << slice;
  }
  EXPECT_NEAR(komo->getPath()(2, 0), .1, 1e-12);
  EXPECT_THROW(komo->updateRootObjects(Config()), ValueError);
}

TEST(ModeSwitches, TheStartMovesInEveryModeButNotWhereItIsVariable) {
  Config config = armAndBox();
  auto komo = std::make_shared<Komo>(config, 3., 1, 2);
  komo->addModeSwitch({2., -1.}, SwitchMode::stable, {"grip", "box"});
  const VectorXd x = komo->path().variables();
  config.setJointState(Eigen::Vector2d(.3, -.2));
  komo->updateRootObjects(config);
  EXPECT_EQ(komo->path().variables(), x);
  for (int slice : {-2, -1}) EXPECT_EQ(komo->configuration(slice).getJointState().head(2), Eigen::Vector2d(.3, -.2));
}

TEST(ModeSwitches, SwitchedPathsGrowLinearlyInVariables) {
  for (int slices : {8, 32}) {
    auto komo = std::make_shared<Komo>(armAndBox(), 2., slices, 2);
    komo->addModeSwitch({1., -1.}, SwitchMode::stable, {"grip", "box"});
    EXPECT_EQ(komo->path().layout().dimension, 2 * slices * 2 + 7);
  }
}

TEST(ModeSwitches, StableJointsOfTheSceneAreOneSetOfVariables) {
  Config config;
  config.addText(
      "w: {} a(w): { joint: hingeX, q: .3 } b(a): { joint: transX, q: .5, joint_stable: true, limits: [-1, 1] } c(b): "
      "{ joint: hingeY, q: .1 }");
  for (int order : {0, 1, 2}) {
    auto komo = std::make_shared<Komo>(config, 3., 1, order);
    komo->addControlObjective({}, 0);
    komo->addObjective({}, FeatureSymbol::jointLimits, {}, ObjectiveType::ineq);
    const auto nlp = makeNlp(komo);
    ASSERT_EQ(nlp->dimension(), 7);
    EXPECT_EQ(nlp->types().size(), 6u + 6u);
    VectorXd x = komo->path().variables(), phi(12);
    const int stable = order > 0 ? 0 : 1;
    x[stable] = .25;
    nlp->evaluate(x, phi, nullptr);
    for (int t = 0; t < 3; ++t) EXPECT_EQ(komo->path().state(t).q()[1], .25);
    EXPECT_NEAR(phi[6], -1.25, 1e-12);
    EXPECT_NEAR(phi[11], -.75, 1e-12);
    std::string where;
    EXPECT_LT(jacobianError(*nlp, *komo, where), 1e-8) << where;
  }
}

TEST(ModeSwitches, AddedFramesHaveTheLimitsThatTheirJointsSuggest) {
  const auto limitsOf = [](JointType type, const char* parent) {
    Komo komo(armAndBox(), 2., 1, 1);
    komo.addFrameDof("new", parent, type, true);
    const int own = komo.path().layout().dimension - 2 * komo.dofs();
    VectorXd both(2 * own);
    both << komo.path().layout().lower.head(own), komo.path().layout().upper.head(own);
    return both;
  };
  const double turns = 4. * std::acos(0.);
  EXPECT_EQ(limitsOf(JointType::hingeZ, "grip"), Eigen::Vector2d(-turns, turns));
  EXPECT_EQ(limitsOf(JointType::transXY, "table"), Eigen::Vector4d(-.8, -.6, .8, .6));
  EXPECT_EQ(limitsOf(JointType::quatBall, "grip").tail(4), Eigen::Vector4d::Constant(1.1));
  EXPECT_FALSE(std::isfinite(limitsOf(JointType::transZ, "table")[0])) << "none";
}

TEST(ModeSwitches, JointLimitsOfTheSceneAreNotThoseOfAddedFrames) {
  const auto komo = std::make_shared<Komo>(armAndBox(), 2., 1, 1);
  komo->addFrameDof("spot", "table", JointType::transXY, false);
  komo->addModeSwitch({2., -1.}, SwitchMode::stable, {"grip", "box"}, false);
  komo->addObjective({}, FeatureSymbol::jointLimits, {}, ObjectiveType::ineq);
  EXPECT_EQ(makeNlp(komo)->types().size(), 2u * 4u + 14u) << "two joints per slice, and the grasp once";
}

TEST(ModeSwitches, ACapsuleBoundsItsGraspByItsLength) {
  Config config = armAndBox();
  config.addFrame("stick")
      .setShape(ShapeType::capsule, {.6, .02})
      .setPose({Vector3d(.3, .2, .63), unitQuaternion({1., 0., 0., 0.})});
  Komo komo(config, 1., 1, 1);
  komo.addModeSwitch({1., -1.}, SwitchMode::stable, {"l2", "stick"});
  EXPECT_DOUBLE_EQ(komo.path().layout().upper[2], .9 * .6);
}

TEST(ModeSwitches, TheCostPerEvaluationGrowsLinearlyWithTheSlicesThatShareAGrasp) {
  const auto secondsPerEvaluation = [](int slices) {
    auto komo = std::make_shared<Komo>(armAndBox(), 2., slices, 2);
    komo->addControlObjective({}, 2, 1e-1);
    komo->addModeSwitch({1., -1.}, SwitchMode::stable, {"grip", "box"});
    komo->addQuaternionNorms();
    komo->addObjective({2.}, FeatureSymbol::position, {"box"}, ObjectiveType::eq, {}, Vector3d(.2, .3, .9));
    const auto nlp = makeNlp(komo);
    SolverOptions options;
    options.stopEvals = 12;
    const std::clock_t start = std::clock();
    const SolverResult result = solveAugmentedLagrangian(*nlp, komo->path().variables(), options);
    return double(std::clock() - start) / CLOCKS_PER_SEC / result.evals;
  };
  const double few = secondsPerEvaluation(100), many = secondsPerEvaluation(800);
  EXPECT_LT(many, 24. * few) << "8 times the slices";  // 8 if linear; 64 and more with fill-in
}

TEST(ModeSwitches, WhatIsAdvisedWithoutVelocitiesWorks) {
  const auto tell = [](std::vector<double> times, bool first) {
    Komo komo(armAndBox(), 3., 1, 0);
    try {
      komo.addModeSwitch(times, SwitchMode::stable, {"grip", "box"}, first);
    } catch (const ValueError& error) {
      EXPECT_TRUE(komo.path().modes().empty() || komo.path().modes().list().size() == 1) << "it began";
      return std::string(error.what());
    }
    EXPECT_EQ(komo.configuration(2).getFrame("box").getParent()->getName(), "grip");
    return std::string();
  };
  EXPECT_NE(tell({1., 2.}, true).find("kOrder 1 or more, or first=false and times [1, -1]"), std::string::npos);
  EXPECT_NE(tell({1., -1.}, true).find("kOrder 1 or more, or first=false"), std::string::npos);
  EXPECT_NE(tell({1., 2.}, false).find("kOrder 1 or more, or times [1, -1]"), std::string::npos);
  EXPECT_EQ(tell({1., -1.}, false), "");
}
