#include "kinegraph/task_planning/lgp/lgp_tool.h"

#include "tests/task_planning/lgp/lgp_scenes.h"

namespace kinegraph {
namespace {

/// A hand on a rail that is to be somewhere.
std::shared_ptr<Komo> atDistance(double distance) {
  Config C;
  C.addFrame("origin");
  C.addFrame("hand", "origin").setJoint(JointType::transX);
  const auto komo = std::make_shared<Komo>(C, 1., 1, 0);
  komo->addObjective({}, FeatureSymbol::positionDiff, {"hand", "origin"}, ObjectiveType::eq, {1., 0., 0.}, distance);
  return komo;
}

TEST(LgpStarts, TheFirstStartThatLeadsToASolutionEndsIt) {
  for (const int threads : {1, 3}) {
    const auto komo = atDistance(.7);
    const LgpSolve solve =
        solveFrom(komo, {VectorXd::Constant(1, 3.), VectorXd::Constant(1, 0.)}, {.threads = threads});
    EXPECT_TRUE(solve.is_solved);
    EXPECT_EQ(solve.solves, 1);
    EXPECT_EQ(solve.evaluations, solve.result.evals);
    EXPECT_NEAR(komo->getPath()(0, 0), .7, 1e-4);
  }
}

TEST(LgpStarts, WhereNoneDoesAllAreTriedAndTheProblemIsLeftWhereTheLastEnded) {
  std::vector<MatrixXd> ends;
  for (const int threads : {1, 2}) {
    LgpOptions options;
    options.threads = threads;
    options.accepts = [](const SolverResult&) { return false; };
    const auto komo = atDistance(.2);
    const LgpSolve solve = solveFrom(komo, {VectorXd::Constant(1, 1.), VectorXd::Constant(1, -1.)}, options);
    EXPECT_FALSE(solve.is_solved);
    EXPECT_EQ(solve.solves, 2);
    EXPECT_GT(solve.evaluations, solve.result.evals);
    EXPECT_EQ(komo->getPath()(0, 0), solve.result.x[0]);
    ends.push_back(komo->getPath());
  }
  EXPECT_EQ(ends[0], ends[1]);
}

TEST(LgpStarts, ProblemsAreSolvedEachAndTakenInOrder) {
  for (const int threads : {1, 2}) {
    std::vector<std::shared_ptr<Komo>> problems;
    for (const double distance : {.1, .2, .3, .4}) problems.push_back(atDistance(distance));
    std::vector<int> taken;
    solveEach(problems, {.threads = threads}, [&](int i, const SolverResult& result) {
      EXPECT_TRUE(result.feasible);
      EXPECT_NEAR(result.x[0], .1 * (i + 1), 1e-4);
      taken.push_back(i);
    });
    EXPECT_EQ(taken, (std::vector{0, 1, 2, 3}));
  }
}

}  // namespace
}  // namespace kinegraph
