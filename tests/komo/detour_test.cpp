#include "kinegraph/komo/detour.h"

#include <gtest/gtest.h>

#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/nlp_solver.h"

namespace kinegraph {

namespace {

/// A ball in the plane, which goes straight through the middle of a wall, high and wide.
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

TEST(Detour, EndsWhereThePathEndsAndGoesAroundWhatIsInTheWay) {
  Komo komo = throughWall(16);
  const MatrixXd given = komo.path().joints();
  MotionProbe probe(1e-5);
  const auto way = detour(komo.path(), .01, probe, 1), again = detour(komo.path(), .01, probe, 1);
  ASSERT_TRUE(way);
  EXPECT_EQ(*way, *again) << "the same for the same number";
  EXPECT_NE(*way, *detour(komo.path(), .01, probe, 2));
  EXPECT_EQ(komo.path().joints(), given) << "the path is as it was";
  int free = 0;
  for (int number = 1; number <= 8; ++number) {
    komo.path().setVariables(*detour(komo.path(), .01, probe, number));
    EXPECT_EQ(komo.path().joints().row(15), given.row(15));
    free += komo.isFree();
    komo.setPath(given);
  }
  EXPECT_GE(free, 1) << "the others may touch on their way";
}

TEST(Detour, IsTakenWhereTheStraightWayIsBlocked) {
  Komo komo = throughWall(16);
  komo.addFreeMotion({}, .005);
  const SolverResult result = komo.solve();
  EXPECT_TRUE(result.feasible) << result.message;
  EXPECT_EQ(result.free(), true);
  EXPECT_TRUE(komo.isFree(.005));
}

TEST(Detour, IsNoneWhereNothingCanBeBent) {
  Config scene;
  scene.addText("base: {}\n ball (base): { joint: quatBall, shape: sphere, size: [.04], contact: 1 }");
  Komo komo(scene, 1, 8, 1);
  MotionProbe probe(1e-5);
  EXPECT_FALSE(detour(komo.path(), .01, probe, 1));
  Komo brief = throughWall(2);
  EXPECT_FALSE(detour(brief.path(), .01, probe, 1));
}

TEST(Detour, AllRefinementsTogetherKeepTheBudget) {
  Config scene;  // the goal is behind a wall that nothing leads around
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
