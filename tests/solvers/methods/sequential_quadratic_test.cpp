#include "kinegraph/solvers/methods/sequential_quadratic.h"

#include <gtest/gtest.h>

#include "kinegraph/base/errors.h"
#include "kinegraph/solvers/methods.h"
#include "tests/solvers/hock_schittkowski.h"
#include "tests/solvers/numbers.h"
#include "tests/support/near.h"

namespace kinegraph {

namespace {

using enum ObjectiveType;

SolverOptions exact() {
  SolverOptions options;
  options.verbose = 0;
  options.stopTolerance = options.stopGTolerance = 1e-8;
  return options;
}

KnownProblem withoutHessian(KnownProblem problem) {
  problem.cost_hessian = {};
  return problem;
}

class SequentialQuadratic : public ::testing::TestWithParam<KnownProblem> {};

/// x in [-1, 1] to be 3, at the price x^2.
KnownProblem unreachable() {
  return {"Unreachable",
          {f, eq},
          VectorXd::Constant(1, -1.),
          VectorXd::Constant(1, 1.),
          VectorXd::Zero(1),
          VectorXd::Ones(1),
          1.,
          [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
            phi << x[0] * x[0], x[0] - 3.;
            J << 2. * x[0], 1.;
          },
          {}};
}

}  // namespace

TEST_P(SequentialQuadratic, FindsTheKnownOptimumFromFirstDerivatives) {
  const KnownProblem problem = withoutHessian(GetParam());
  KnownNlp nlp(problem);
  const SolverResult result = solveSequentialQuadratic(nlp, problem.start, exact());
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_LE(result.violation, 1e-8);
  EXPECT_TRUE(near(result.x, problem.optimum, 1e-5));
  EXPECT_NEAR(result.f + result.sos, problem.cost, 1e-8 * std::max(1., std::abs(problem.cost)));
  EXPECT_LE(result.evals, 60);
}

TEST_P(SequentialQuadratic, IsTheSameBitsTwice) {
  const KnownProblem problem = withoutHessian(GetParam());
  KnownNlp one(problem), two(problem);
  EXPECT_EQ(solveSequentialQuadratic(one, problem.start, exact()).x,
            solveSequentialQuadratic(two, problem.start, exact()).x);
}

INSTANTIATE_TEST_SUITE_P(HockSchittkowski, SequentialQuadratic, ::testing::ValuesIn(knownProblems()),
                         [](const auto& info) { return info.param.name; });

TEST(SequentialQuadratic, IsWhatTheDefaultMethodUsesWhereTheCurvatureHasToBeLearnt) {
  for (const KnownProblem& problem : knownProblems()) {
    KnownNlp with(problem), without(withoutHessian(problem));
    const bool has_f = std::find(problem.types.begin(), problem.types.end(), f) != problem.types.end();
    const CostCurvature untold = has_f ? CostCurvature::unknown : CostCurvature::squares;
    EXPECT_EQ(costCurvature(without, problem.start), untold) << problem.name;
    EXPECT_EQ(costCurvature(with, problem.start), has_f && problem.cost_hessian ? CostCurvature::known : untold)
        << problem.name;
  }
}

TEST(SequentialQuadratic, StopsAtTheLimitOfEvaluationsWithTheBestPoint) {
  const KnownProblem problem = withoutHessian(knownProblems().back());
  KnownNlp nlp(problem);
  SolverOptions options = exact();
  options.stopEvals = 3;
  const SolverResult result = solveSequentialQuadratic(nlp, problem.start, options);
  EXPECT_EQ(result.status, SolverStatus::limit);
  EXPECT_LE(result.evals, 4);  // one more may be the corrected step
}

TEST(SequentialQuadratic, StopsWhenTheCallerSaysSo) {
  const KnownProblem problem = withoutHessian(knownProblems().back());
  KnownNlp nlp(problem);
  int calls = 0;
  const SolverResult result = solveSequentialQuadratic(nlp, problem.start, exact(),
                                                       [&](const VectorXd&, const VectorXd&) { return ++calls < 3; });
  EXPECT_EQ(result.status, SolverStatus::cancelled);
  EXPECT_EQ(result.evals, 3);
}

TEST(SequentialQuadratic, ThatFailsLeavesTheProblemToTheAugmentedLagrangian) {
  KnownNlp nlp(unreachable());
  EXPECT_NE(solveSequentialQuadratic(nlp, VectorXd::Zero(1), exact()).status, SolverStatus::converged);
  const SolverResult result = solve(nlp, VectorXd::Zero(1), exact());
  EXPECT_EQ(result.status, SolverStatus::infeasible) << result.message;
  EXPECT_NEAR(result.x[0], 1., 1e-9);
  EXPECT_NEAR(result.violation, 2., 1e-9);
}

TEST(SequentialQuadratic, GoesBackFromWhereNumbersAreNotFinite) {
  const KnownProblem problem{"Log",
                             {f},
                             VectorXd::Constant(1, -kInf),
                             VectorXd::Constant(1, kInf),
                             VectorXd::Constant(1, 5.),
                             VectorXd::Ones(1),
                             1.,
                             [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
                               phi << x[0] - std::log(x[0]);
                               J << 1. - 1. / x[0];
                             },
                             {}};
  KnownNlp nlp(problem);
  const SolverResult result = solveSequentialQuadratic(nlp, problem.start, exact());
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_NEAR(result.x[0], 1., 1e-6);
  EXPECT_THROW(solveSequentialQuadratic(nlp, VectorXd::Constant(1, -1.), exact()), ValueError);
}

}  // namespace kinegraph
