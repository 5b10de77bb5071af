#include <gtest/gtest.h>

#include "kinegraph/api/solutions.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/trajectory_optimization/motion_problems.h"
#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph {
namespace {

constexpr const char* kScene = "base: { } \n hand (base): { joint: transX, limits: [-2 2] } \n goal: { X: [1 0 0] }";

/// From 0 to the goal at 1, within three slices.
Komo motion(double weight = 1.) {
  Config config;
  config.addText(kScene);
  Komo komo(config, 1., 3, 1);
  komo.addControlObjective({}, 1, weight);
  komo.addObjective({1.}, FeatureSymbol::positionDiff, {"hand", "goal"}, ObjectiveType::eq, 10.);
  return komo;
}

TEST(KomoCalls, SolveLeavesThePathAtTheResult) {
  Komo komo = motion();
  const SolverResult result = komo.solve();
  EXPECT_TRUE(result.feasible) << result.message;
  EXPECT_TRUE(komo.getPath().isApprox(MatrixXd{{1. / 3}, {2. / 3}, {1.}}, 1e-4)) << komo.getPath();

  SolverOptions of_nobody;
  of_nobody.method = OptMethod::greedy;
  EXPECT_THROW(komo.solve(of_nobody), Error);
}

TEST(KomoCalls, NlpIsAProblemOfThisPath) {
  Komo komo = motion();
  const std::shared_ptr<Nlp> nlp = komo.nlp();
  EXPECT_EQ(nlp->dimension(), 3);
  VectorXd phi(nlp->types().size());
  nlp->evaluate(VectorXd{{.1, .2, .3}}, phi, nullptr);
  EXPECT_EQ(komo.getPath()(2, 0), .3);
}

TEST(KomoCalls, ManyStartsGiveTheSameAtAnyNumberOfThreads) {
  Komo one = motion(), two = motion();
  const SolveManyResult alone = one.solveFromMany(4, {.threads = 1}, 3),
                        shared = two.solveFromMany(4, {.threads = 2}, 3);
  ASSERT_EQ(alone.results.size(), 4u);
  EXPECT_TRUE(alone.best().feasible);
  EXPECT_EQ(alone.chosen, shared.chosen);
  EXPECT_EQ(one.getPath(), two.getPath());
  EXPECT_THROW(one.solveFromMany(0, {}), ValueError);
}

TEST(KomoCalls, SolveAllSolvesEachAndChoosesTheCheapest) {
  std::vector<Komo> problems;
  for (double weight : {3., 1., 2.}) problems.push_back(motion(weight));
  const SolveManyResult all = solveAll(problems, {.threads = 2});
  EXPECT_EQ(all.chosen, 1);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    EXPECT_TRUE(all.results[i].feasible);
    EXPECT_NEAR(problems[i].getPath()(2, 0), 1., 1e-4);
  }
  EXPECT_THROW(solveAll(std::span<Komo>()), ValueError);
}

TEST(KomoCalls, ViewShowsThePathOnAPageOfItsOwn) {
  setenv("KINEGRAPH_HEADLESS", "1", 1);
  Komo komo = motion();
  EXPECT_EQ(komo.view(true), 0);
  EXPECT_TRUE(komo.viewer().isOpen());
  EXPECT_EQ(komo.viewer().message(), "all 4 slices");
  EXPECT_EQ(komo.viewPlay(false, "", .01), 0);
  Komo copy = komo.clone();
  EXPECT_NE(&copy.viewer(), &komo.viewer());
}

}  // namespace
}  // namespace kinegraph
