#include "kinegraph/komo/collision/alternative_path.h"

#include <gtest/gtest.h>

#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/nlp_solver.h"

namespace kinegraph {

namespace {

/// A ball in the plane that moves straight through a wide and high wall.
Komo throughWall(int slices) {
  Config scene;
  scene.addText(R"g(
    base: {}
    ball (base): { joint: transXY, shape: sphere, size: [.04], contact: 1 }
    wall (base): { Q: [.5 0 0], shape: box, size: [.03 .6 1.], contact: 1 }
  )g");
  Komo komo(scene, 1, slices, 2);
  komo.addControlObjective({}, 2, 1.);
  komo.addObjective({1.}, FeatureSymbol::qItself, {}, ObjectiveType::eq, 10., Eigen::Vector2d(1., 0.));
  MatrixXd path = MatrixXd::Zero(slices, 2);
  path.col(0).setLinSpaced(slices, 1. / slices, 1.);
  komo.setPath(path);
  return komo;
}

}  // namespace

TEST(AlternativePath, EndsWhereThePathEndsAndAvoidsObstacles) {
  Komo komo = throughWall(16);
  const MatrixXd given = komo.path().joints();
  MotionProbe probe(1e-5);
  const auto way = alternativePath(komo.path(), .01, probe, 1), again = alternativePath(komo.path(), .01, probe, 1);
  ASSERT_TRUE(way);
  EXPECT_EQ(*way, *again) << "the same for the same number";
  EXPECT_NE(*way, *alternativePath(komo.path(), .01, probe, 2));
  EXPECT_EQ(komo.path().joints(), given) << "the path is as it was";
  for (int number = 1; number <= 8; ++number) {
    komo.path().setVariables(*alternativePath(komo.path(), .01, probe, number));
    EXPECT_EQ(komo.path().joints().row(15), given.row(15));
    EXPECT_TRUE(komo.isFree(.01 - 2e-5)) << "at all times, number " << number;
    komo.setPath(given);
  }
}

TEST(AlternativePath, KeepsTheConfigurationsAtTheEndsOfPhases) {
  for (const int order : {0, 2}) {
    Config scene;
    scene.addText(R"g(
      base: {}
      ball (base): { joint: transXY, shape: sphere, size: [.04], contact: 1 }
      wall (base): { Q: [.5 0 0], shape: box, size: [.03 .6 1.], contact: 1 }
      bar (base): { Q: [.9 .3 0], shape: box, size: [.3 .03 1.], contact: 1 }
    )g");
    Komo komo(scene, 3, 8, order);
    MatrixXd path(24, 2);
    for (int t = 0; t < 24; ++t) {  // through the wall, to the other side of the bar
      path(t, 0) = std::min(1., (t + 1) / 8.);
      path(t, 1) = std::clamp((t - 7) / 8., 0., 1.) * .6;
    }
    komo.setPath(path);
    MotionProbe probe(1e-5);
    for (int number = 1; number <= 8; ++number) {
      komo.path().setVariables(*alternativePath(komo.path(), .01, probe, number));
      const MatrixXd found = komo.path().joints();
      for (const int t : {7, 15, 20, 23}) EXPECT_EQ(found.row(t), path.row(t)) << t;
      EXPECT_TRUE(komo.isFree(.01 - 2e-5)) << number;
      EXPECT_EQ(order == 0, found.row(0) == path.row(0))
          << "without slices before it, the first one is where it begins";
      komo.setPath(path);
    }
  }
}

TEST(AlternativePath, KeepsHalfOfTheClearanceOfAnEnd) {
  Komo komo = throughWall(16);
  MatrixXd path = komo.path().joints();
  path.col(0) *= .565;  // the ball's end is 1 cm behind the wall
  komo.setPath(path);
  MotionProbe probe(1e-5);
  for (int number = 1; number <= 4; ++number) {
    komo.path().setVariables(*alternativePath(komo.path(), .03, probe, number));
    EXPECT_TRUE(komo.isFree(.005 - 2e-5)) << number;
    EXPECT_FALSE(komo.isFree(.0101));
    komo.setPath(path);
  }
}

TEST(AlternativePath, ViolatesTheMarginLessThanThePathIfAnEndIsBlocked) {
  Komo komo = throughWall(16);
  MatrixXd path = komo.path().joints();
  path.col(0) *= .5;  // into the wall
  komo.setPath(path);
  MotionProbe probe(1e-5);
  const auto blocked = [&] { return komo.checkMotion(0., 1e-5).size(); };
  const std::size_t before = blocked();
  for (int number = 1; number <= 4; ++number) {
    komo.path().setVariables(*alternativePath(komo.path(), .01, probe, number));
    EXPECT_EQ(komo.path().joints().row(15), path.row(15));
    EXPECT_LE(blocked(), before);
    komo.setPath(path);
  }
}

TEST(AlternativePath, IsUsedIfTheStraightPathIsBlocked) {
  Komo komo = throughWall(16);
  komo.addFreeMotion({}, .005);
  const SolverResult result = komo.solve();
  EXPECT_TRUE(result.feasible) << result.message;
  EXPECT_EQ(result.free(), true);
  EXPECT_TRUE(komo.isFree(.005));
}

TEST(AlternativePath, DoesNotExistIfNothingCanBeVaried) {
  Config scene;
  scene.addText("base: {}\n ball (base): { joint: quatBall, shape: sphere, size: [.04], contact: 1 }");
  Komo komo(scene, 1, 8, 1);
  MotionProbe probe(1e-5);
  EXPECT_FALSE(alternativePath(komo.path(), .01, probe, 1));
  Komo brief = throughWall(2);
  EXPECT_FALSE(alternativePath(brief.path(), .01, probe, 1));
}

TEST(AlternativePath, AllRefinementsTogetherKeepTheBudget) {
  Config scene;  // the goal is enclosed by a wall
  scene.addText(R"g(
    base: {}
    ball (base): { joint: transX, shape: sphere, size: [.04], contact: 1 }
    wall (base): { Q: [.5 0 0], shape: box, size: [.03 1 1], contact: 1 }
  )g");
  Komo komo(scene, 1, 10, 2);
  komo.addControlObjective({}, 2, 1.);
  komo.addObjective({1.}, FeatureSymbol::qItself, {}, ObjectiveType::eq, 10., VectorXd::Constant(1, 1.));
  komo.addFreeMotion({}, .005);
  NlpSolver solver(makeNlp(std::make_shared<Komo>(std::move(komo))), 0);
  solver.options.stopEvals = 300;
  const SolverResult result = solver.solve();
  EXPECT_FALSE(result.feasible);
  EXPECT_LE(result.evals, 300 + 8 * 50) << "of which some are the search for the least violation";
}

}  // namespace kinegraph
