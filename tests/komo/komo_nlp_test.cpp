#include <gtest/gtest.h>

#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "kinegraph/solvers/problems/penalty_nlp.h"
#include "tests/support/differences.h"
#include "tests/support/near.h"

namespace kinegraph {

namespace {

/// Two balls that overlap at the start, and a wall between them and their goals.
std::shared_ptr<Komo> slidingBalls(ObjectiveType type = ObjectiveType::eq) {
  Config scene;
  scene.addText(R"g(
    base: {}
    a (base): { joint: transXY, shape: sphere, size: [.1], contact: 1 }
    b (base): { pre: "t(0 .15 0)", joint: transXY, shape: sphere, size: [.1], contact: 1 }
    wall (base): { Q: [.3 .05 0], shape: box, size: [.1 .1 1.], contact: 1 }
  )g");
  auto komo = std::make_shared<Komo>(scene, 1, 4, 1);
  komo->addControlObjective({}, 1, 1.);
  komo->addObjective({}, FeatureSymbol::accumulatedCollisions, {}, type, 10.);
  komo->addObjective({1.}, FeatureSymbol::qItself, {}, ObjectiveType::eq, {}, Eigen::Vector4d(.5, .5, .5, .6));
  return komo;
}

}  // namespace

TEST(KomoNlp, SeparatesSumsOfOverlapsIntoPairsAndJoinsThemAgain) {
  const auto nlp = makeNlp(slidingBalls());
  const Separation separation = nlp->separation();
  ASSERT_TRUE(separation.problem);
  Nlp& pairs = *separation.problem;
  EXPECT_EQ(pairs.types().size(), nlp->types().size() + 4 * 2) << "three pairs for one sum, in four slices";
  EXPECT_EQ(pairs.dimension(), nlp->dimension());
  Rng rng(3);
  Jacobian J = pairs.makeJacobian();
  VectorXd phi(Eigen::Index(pairs.types().size())), sums(Eigen::Index(nlp->types().size()));
  bool overlaps = false;
  for (int trial = 0; trial < 20; ++trial) {
    VectorXd x(nlp->dimension());
    for (double& value : x) value = rng.uniform(-.1, .5);
    pairs.evaluate(x, phi, &J);
    nlp->evaluate(x, sums, nullptr);
    EXPECT_TRUE(near(separation.joined(phi, sums.size()), sums, 1e-12));
    overlaps = overlaps || sumErrors(nlp->types(), sums).eq > .1;
  }
  EXPECT_TRUE(overlaps);
}

TEST(KomoNlp, HasTheJacobianOfDifferencesWithLinearRowsAsTheyWereMade) {
  const auto komo = slidingBalls();
  komo->addControlObjective({}, 0, 1e-2);
  komo->addObjective({}, FeatureSymbol::positionDiff, {"a", "wall"}, ObjectiveType::sos, 2., {}, 1);
  const auto nlp = makeNlp(komo);
  const int rows = int(nlp->types().size());
  int linear = 0;
  for (int row = 0; row < rows; ++row) linear += nlp->isLinear(row);
  EXPECT_GT(linear, 0);
  EXPECT_LT(linear, rows);
  Rng rng(5);
  for (int trial = 0; trial < 5; ++trial) {
    VectorXd x(nlp->dimension());
    for (double& value : x) value = rng.uniform(.6, 1.5);  // away from the wall
    EXPECT_LT(checkJacobian(*nlp, x).error, 1e-6);
  }
}

TEST(KomoNlp, HasSecondDerivativesOfRowsOfOneSlice) {
  Config scene;
  scene.addText(R"g(
    base: {}
    upper (base): { joint: hingeZ }
    lower (upper): { pre: "t(.3 0 .1)", joint: hingeY }
    tip (lower): { Q: "t(0 .1 .2)" }
    goal: { X: "t(.3 .2 .1)" }
  )g");
  auto komo = std::make_shared<Komo>(scene, 1, 3, 2);
  komo->addControlObjective({}, 2, 1.);
  komo->addObjective({}, FeatureSymbol::position, {"tip"}, ObjectiveType::ineq, .5);
  komo->addObjective({1.}, FeatureSymbol::positionDiff, {"tip", "goal"}, ObjectiveType::eq, 10.);
  const auto nlp = makeNlp(komo);
  const int n = nlp->dimension();
  const auto curved = nlp->curvedRows();
  ASSERT_EQ(curved.size(), 4u);
  Rng rng(6);
  VectorXd x(n), phi(Eigen::Index(nlp->types().size()));
  for (double& value : x) value = rng.normal();
  Jacobian J = nlp->makeJacobian();
  for (int k = 0; k < int(curved.size()); ++k) {
    const Nlp::CurvedRows& rows = curved[std::size_t(k)];
    VectorXd weights(rows.rows);
    for (double& weight : weights) weight = rng.normal();
    const auto gradient = [&](const VectorXd& at) -> VectorXd {
      nlp->evaluate(at, phi, &J);
      VectorXd sum = VectorXd::Zero(n);
      for (int i = 0; i < rows.rows; ++i) J.addRowTo(rows.first + i, weights[i], sum);
      return sum;
    };
    const Differences numeric = differences(gradient, x);
    nlp->evaluate(x, phi, nullptr);
    MatrixXd H = MatrixXd::Zero(n, n), block = MatrixXd::Zero(rows.width, rows.width);
    nlp->addCurvature(k, {weights.data(), std::size_t(rows.rows)}, block);
    block.triangularView<Eigen::StrictlyUpper>() = block.transpose();
    H.block(rows.column, rows.column, rows.width, rows.width) = block;
    EXPECT_LE(relativeError(H, numeric.D), 1e-6);
  }
}

TEST(KomoNlp, MarksZeroRowsAndLeavesNothingOfEarlierPointsInThem) {
  const auto komo = slidingBalls();
  const Separation separation = makeNlp(komo)->separation();
  ASSERT_TRUE(separation.problem);
  Nlp& pairs = *separation.problem;
  Jacobian J = pairs.makeJacobian();
  VectorXd phi(Eigen::Index(pairs.types().size()));
  Rng rng(4);
  int zero_rows = 0, returned = 0;
  std::vector<char> before = J.zero_row;
  for (int trial = 0; trial < 40; ++trial) {
    VectorXd x(pairs.dimension());
    for (double& value : x) value = rng.uniform(-1., 1.);
    pairs.evaluate(x, phi, &J);
    Jacobian fresh = pairs.makeJacobian();
    pairs.evaluate(x, phi, &fresh);
    EXPECT_TRUE(J.toDense() == fresh.toDense());
    for (int row = 0; row < J.rows(); ++row) {
      if (J.zero_row[std::size_t(row)]) EXPECT_TRUE(fresh.toDense().row(row).isZero(0.)) << pairs.rowName(row);
      zero_rows += J.zero_row[std::size_t(row)];
      returned += before[std::size_t(row)] && !J.zero_row[std::size_t(row)];
    }
    before = J.zero_row;
  }
  EXPECT_GT(zero_rows, 100);
  EXPECT_GT(returned, 20);
}

TEST(KomoNlp, AsPenaltiesAndBarriersItHasTheSameJacobianEachTime) {
  const std::shared_ptr<Nlp> nlp = makeNlp(slidingBalls());
  for (const std::shared_ptr<Nlp>& penalized : {makePenalized(nlp, 25., -1.), makePenalized(nlp, 25., .1)}) {
    Jacobian J = penalized->makeJacobian();
    VectorXd phi(Eigen::Index(penalized->types().size()));
    const VectorXd x = VectorXd::Constant(nlp->dimension(), .7);
    penalized->evaluate(x, phi, &J);
    const MatrixXd first = J.toDense();
    penalized->evaluate(x, phi, &J);
    EXPECT_TRUE(J.toDense() == first);
    EXPECT_LT(checkJacobian(*penalized, x).error, 1e-6);
  }
}

TEST(KomoNlp, HasNothingToSeparateWhereNoSumIsDemandedToBeZero) {
  EXPECT_FALSE(makeNlp(slidingBalls(ObjectiveType::sos))->separation().problem);
}

TEST(KomoNlp, IsSolvedWithoutCollisionsThroughItsPairs) {
  const auto nlp = makeNlp(slidingBalls());
  NlpSolver solver(nlp, 0);
  solver.options.verbose = 0;
  solver.setTracing(true, true, true);
  solver.setInitialization(VectorXd::Zero(nlp->dimension()));
  Rng rng(0);
  const SolverResult result = solver.solve(false, rng);
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_LT(result.violation, 1e-3);
  EXPECT_EQ(result.dual.size(), Eigen::Index(nlp->types().size()));
  ASSERT_FALSE(solver.tracePhi().empty());
  EXPECT_EQ(solver.tracePhi().back().size(), Eigen::Index(nlp->types().size()))
      << "traces are of the problem as it was stated";
  const SolverResult again = solver.solve(false, rng);
  EXPECT_LE(again.evals - result.evals, 3) << "goes on with the multipliers of the pairs";
}

}  // namespace kinegraph
