#include "kinegraph/komo/komo.h"

#include <gtest/gtest.h>

#include <chrono>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/solvers/methods/augmented_lagrangian.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

Config panda() {
  Config config;
  config.addFile(std::string(KINEGRAPH_SOURCE_DIR) + "/models/scenarios/pandaSingle.g");
  config.addFrame("target", "table").setShape(ShapeType::marker, {.1}).setRelativePosition({0., .3, .3});
  return config;
}

std::shared_ptr<Komo> tutorialIk(const Config& config) {
  const VectorXd home = (VectorXd(7) << 0., -.5, 0., -2., 0., 2., -.5).finished();
  auto komo = std::make_shared<Komo>(config, 1., 1, 0);
  komo->addObjective({}, FeatureSymbol::qItself, {}, ObjectiveType::sos, .1, config.getJointState());
  komo->addObjective({}, FeatureSymbol::qItself, {}, ObjectiveType::sos, .1, home);
  komo->addObjective({}, FeatureSymbol::positionDiff, {"l_gripper", "target"}, ObjectiveType::eq, 10.);
  return komo;
}

}  // namespace

TEST(Komo, TheTutorialsInverseKinematicsReachesEveryTarget) {
  Config config = panda();
  Rng rng(5);
  const Vector3d center = config.getFrame("target").getPose().p;
  Vector3d position = center;
  int evals = 0;
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 3; ++k) position[k] = center[k] + .98 * (position[k] - center[k]) + .02 * rng.normal();
    config.getFrame("target").setPosition(position);
    const auto komo = tutorialIk(config);
    const auto nlp = makeNlp(komo);
    Rng noise(0);
    const SolverResult result = solveAugmentedLagrangian(*nlp, nlp->initialPoint(noise), SolverOptions{});
    EXPECT_TRUE(result.feasible);
    EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
    config.setJointState(komo->getPath().row(0));
    EXPECT_LT((config.getFrame("l_gripper").getPose().p - position).norm(), 1e-5);
    evals += result.evals;
  }
  EXPECT_LT(evals / 20., 8.);
  RecordProperty("evaluations", evals);
}

TEST(Komo, AStoredPathBeginsAtThePresentConfiguration) {
  const VectorXd elsewhere = (VectorXd(7) << .2, -.4, .1, -1.8, .1, 1.9, -.3).finished();
  const auto reach = [](const Config& config) {
    auto komo = std::make_shared<Komo>(config, 1., 8, 2);
    komo->addControlObjective({}, 2);
    komo->addObjective({1.}, FeatureSymbol::positionDiff, {"l_gripper", "target"}, ObjectiveType::eq, 10.);
    komo->addObjective({1.}, FeatureSymbol::qItself, {}, ObjectiveType::eq, 1., {}, 1);
    return komo;
  };
  Config config = panda();
  const auto kept = reach(config);
  const auto nlp = makeNlp(kept);
  const VectorXd start = kept->path().variables();
  solveAugmentedLagrangian(*nlp, start, SolverOptions{});
  config.setJointState(elsewhere);
  config.getFrame("target").setRelativePosition({.1, .3, .3});
  kept->updateRootObjects(config);
  EXPECT_EQ(kept->path().state(-1).q(), elsewhere);
  EXPECT_EQ(kept->path().state(-2).q(), elsewhere);
  EXPECT_EQ(kept->path().initial().config().getJointState(), elsewhere);
  const auto fresh = reach(config);
  const SolverResult of_kept = solveAugmentedLagrangian(*nlp, start, SolverOptions{}),
                     of_fresh = solveAugmentedLagrangian(*makeNlp(fresh), start, SolverOptions{});
  EXPECT_TRUE(of_kept.feasible);
  EXPECT_EQ(of_kept.x, of_fresh.x);
  EXPECT_LT((kept->getPath().row(0).transpose() - elsewhere).norm(), .1);
}

TEST(Komo, ReachesAllFarTargetsFromRandomStarts) {
  Config config = panda();
  Rng rng(1);
  int solved = 0, evals = 0;
  for (int i = 0; i < 20; ++i) {
    const auto nlp = makeNlp(tutorialIk(config));
    VectorXd x(7);
    for (int k = 0; k < 7; ++k)
      x[k] = rng.uniform(.9 * nlp->lower()[k] + .1 * nlp->upper()[k], .1 * nlp->lower()[k] + .9 * nlp->upper()[k]);
    const SolverResult result = solveAugmentedLagrangian(*nlp, x, SolverOptions{});
    solved += result.feasible;
    evals += result.evals;
  }
  EXPECT_GE(solved, 19);
  EXPECT_LT(evals / 20., 30.);
  RecordProperty("evaluations", evals);
}

TEST(Komo, SaysThatATargetOutOfReachIsInfeasible) {
  Config config = panda();
  config.getFrame("target").setPosition({3., 0., 1.});
  const auto komo = tutorialIk(config);
  const auto nlp = makeNlp(komo);
  const SolverResult result = solveAugmentedLagrangian(*nlp, nlp->lower(), SolverOptions{});
  EXPECT_FALSE(result.feasible);
  EXPECT_EQ(result.status, SolverStatus::infeasible) << result.message << " after " << result.evals;
  EXPECT_LE(result.evals, 120);
}

TEST(Komo, JacobiansOfPathsEqualCentralDifferences) {
  Config config = panda();
  auto komo = std::make_shared<Komo>(config, 1., 5, 2);
  komo->addControlObjective({}, 2, 1e-1);
  komo->addControlObjective({}, 1, 1e-1);
  komo->addControlObjective({}, 0, 1e-1);
  komo->addObjective({.5, 1.}, FeatureSymbol::poseDiff, {"l_gripper", "target"}, ObjectiveType::sos, {}, {}, 1);
  komo->addObjective({}, FeatureSymbol::angularVel, {"l_gripper"}, ObjectiveType::sos);
  komo->addObjective({}, FeatureSymbol::linangVel, {"l_gripper"}, ObjectiveType::eq, 2., {}, 2);
  komo->addObjective({1.}, FeatureSymbol::positionDiff, {"l_gripper", "target"}, ObjectiveType::eq, 10.);
  const auto nlp = makeNlp(komo);
  Rng rng(3);
  VectorXd x = nlp->initialPoint(rng);
  for (double& value : x) value += .2 * rng.normal();
  const JacobianCheck check = checkJacobian(*nlp, x);
  EXPECT_LT(check.error, 1e-6) << nlp->rowName(check.row) << " column " << check.column << ": " << check.analytic << " "
                               << check.numeric;
}

TEST(Komo, LongerPathsTakeNoMoreEvaluations) {
  Config config = panda();
  double previous = 0.;
  for (int slices : {32, 128}) {
    auto komo = std::make_shared<Komo>(config, 1., slices, 2);
    komo->addControlObjective({}, 2);
    komo->addObjective({1.}, FeatureSymbol::positionDiff, {"l_gripper", "target"}, ObjectiveType::eq, 10.);
    komo->addObjective({1.}, FeatureSymbol::qItself, {}, ObjectiveType::eq, {}, {}, 1);
    const auto nlp = makeNlp(komo);
    Rng rng(0);
    const SolverResult result = solveAugmentedLagrangian(*nlp, nlp->initialPoint(rng), SolverOptions{});
    EXPECT_TRUE(result.feasible) << result.message;
    if (previous > 0.) {
      EXPECT_LT(result.evals, 2. * previous + 10.);
    }
    previous = result.evals;
  }
}

TEST(Komo, WarnsOfObjectivesThatSelectNothingAndExplainsMistakes) {
  Config config = panda();
  Komo komo(config, 1., 10, 1);
  komo.addObjective({3.}, FeatureSymbol::position, {"l_gripper"}, ObjectiveType::eq);
  ASSERT_EQ(komo.takeWarnings().size(), 1u);
  EXPECT_THROW(komo.addObjective({}, FeatureSymbol::position, {"l_griper"}, ObjectiveType::eq), FrameNotFound);
  EXPECT_THROW(komo.addObjective({}, FeatureSymbol::position, {}, ObjectiveType::eq), ValueError);
  EXPECT_THROW(komo.addObjective({}, FeatureSymbol::position, {"l_gripper"}, ObjectiveType::eq, {}, VectorXd::Zero(2)),
               ValueError);
  EXPECT_THROW(komo.addObjective({}, FeatureSymbol::position, {"l_gripper"}, ObjectiveType::eq, {}, {}, 2), ValueError);
  EXPECT_THROW(Komo().addObjective({}, FeatureSymbol::position, {"a"}, ObjectiveType::eq), Error);
}

TEST(Komo, ControlObjectivesAreScaledByTime) {
  Config config;
  config.addText("a: {} b(a): { joint: transX }");
  for (const auto& [slices, first, second] : {std::tuple{4, .2, .8}, std::tuple{10, .31623, 3.16228}}) {
    auto komo = std::make_shared<Komo>(config, 1., slices, 2);
    komo->addControlObjective({}, 1);
    komo->addControlObjective({}, 2);
    const auto nlp = makeNlp(komo);
    VectorXd x(slices), phi(2 * slices);
    for (int t = 0; t < slices; ++t) x[t] = .1 * (t + 1);
    nlp->evaluate(x, phi, nullptr);
    EXPECT_NEAR(phi[0], first, 1e-5);
    EXPECT_NEAR(phi[slices], second, 1e-5);
    EXPECT_NEAR(phi[slices + 1], 0., 1e-12);
  }
}

/// It takes over little where little was changed: positions of single frames, of many, joints, colors and masses, also
/// while copies of the scene are held by others.
TEST(Komo, UpdateRootObjectsFollowsEveryEditThatKeepsTheStructure) {
  Config config = panda();
  for (int i = 0; i < 12; ++i)
    config.addFrame(cat("stone", i), i % 3 ? "table" : "").setShape(ShapeType::box, {.05, .05, .05}).setMass(1.);
  const auto komo = tutorialIk(config);
  Rng rng(9);
  std::vector<std::shared_ptr<Komo>> others;
  const auto randomPosition = [&] { return Vector3d(rng.normal(), rng.normal(), rng.normal()); };
  for (int trial = 0; trial < 80; ++trial) {
    const int edits = rng.uniform() < .1 ? 12 : int(3. * rng.uniform());
    for (int i = 0; i < edits; ++i)
      config.getFrame(cat("stone", int(12. * rng.uniform()))).setPosition(randomPosition());
    if (rng.uniform() < .5) config.getFrame("target").setPosition(randomPosition());
    if (rng.uniform() < .3) config.setJointState(config.getJointState() + VectorXd::Constant(7, .01 * rng.normal()));
    if (rng.uniform() < .1) config.getFrame("stone1").setColor({rng.uniform(), .5, .5});
    if (rng.uniform() < .1) config.getFrame("stone2").setMass(rng.uniform(.1, 2.));
    if (rng.uniform() < .1) others.push_back(tutorialIk(config));
    if (rng.uniform() < .1) others.clear();
    komo->updateRootObjects(config);
    komo->setConstantPath(config.getJointState());
    const auto fresh = tutorialIk(config);
    EXPECT_EQ(komo->getFrameState(0), fresh->getFrameState(0)) << "trial " << trial;
    const Config before = komo->configuration(0);
    const std::vector<Frame> copies = before.getFrames(), originals = config.getFrames();
    ASSERT_EQ(copies.size(), originals.size());
    for (std::size_t f = 0; f < copies.size(); ++f) {
      EXPECT_EQ(copies[f].getPose().p, originals[f].getPose().p) << originals[f].getName();
      EXPECT_EQ(copies[f].getMass(), originals[f].getMass());
    }
    EXPECT_EQ(before.getJointState(), config.getJointState());
  }
}

TEST(Komo, AnObjectiveMayHaveATargetPerSlice) {
  Config config = panda();
  const Vector3d begin = config.getFrame("l_gripper").getPose().p;
  MatrixXd points(10, 3);
  for (int k = 0; k < 10; ++k) points.row(k) = (begin + k / 9. * Vector3d(.1, .2, -.1)).transpose();
  Komo komo(config, 2., 10, 2);
  komo.addControlObjective({}, 2, 1e-1);
  komo.addObjectivePerSlice({1.1, 2.}, FeatureSymbol::position, {"l_gripper"}, ObjectiveType::eq, points, 10.);
  ASSERT_TRUE(komo.solve().feasible);
  const MatrixXd path = komo.getPath();
  for (int k = 0; k < 10; ++k) {
    config.setJointState(path.row(10 + k).transpose());
    EXPECT_LT((config.getFrame("l_gripper").getPose().p - points.row(k).transpose()).norm(), 1e-3);
  }
  expectError<ValueError>(
      [&] {
        komo.addObjectivePerSlice({.1, .5}, FeatureSymbol::position, {"l_gripper"}, ObjectiveType::eq, points);
      },
      {"targets have 10 rows; expected 5, one per slice"});
}
