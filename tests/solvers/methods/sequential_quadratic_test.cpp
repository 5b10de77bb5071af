#include "kinegraph/solvers/methods/sequential_quadratic.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "kinegraph/solvers/nlp_solver.h"
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

/// HS54, whose variables are from 1e-3 to 1e8 in size and where the costs are nearly level along the largest; times
/// `size`.
KnownProblem variablesOfAllSizes(double size) {
  const VectorXd optimum = size * (VectorXd(6) << 91600. / 7., 79. / 70., 2e6, 10., 1e-3, 1e8).finished();
  return {"HS54",
          {f, eq},
          size * (VectorXd(6) << 0., -10., 0., 0., -1., 0.).finished(),
          size * (VectorXd(6) << 2e4, 10., 1e7, 20., 1., 2e8).finished(),
          size * (VectorXd(6) << 6e3, 1.5, 4e6, 2., 3e-3, 5e7).finished(),
          optimum,
          -std::exp(-27. / 280.),
          [size](const VectorXd& scaled, VectorXd& phi, MatrixXd& J) {
            const VectorXd x = scaled / size;
            const double a = x[0] - 1e4, b = x[1] - 1., c = x[2] - 2e6, d = x[3] - 10., e = x[4] - 1e-3, g = x[5] - 1e8;
            const double exponent = (a * a / 6.4e7 + a * b / 2e4 + b * b) / 1.92 + c * c / 9.8e13 + d * d / 5e3 +
                                    e * e / 5e-3 + g * g / 5e17;
            phi << -std::exp(-exponent), x[0] + 4e3 * x[1] - 1.76e4;
            J.row(0) << (2. * a / 6.4e7 + b / 2e4) / 1.92, (a / 2e4 + 2. * b) / 1.92, 2. * c / 9.8e13, 2. * d / 5e3,
                2. * e / 5e-3, 2. * g / 5e17;
            J.row(0) *= std::exp(-exponent);
            J.row(1) << 1., 4e3, 0., 0., 0., 0.;
            J /= size;
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

TEST(SequentialQuadratic, ConvergesWhereTheCostsAreLevelInUnitsOfEachVariable) {
  for (const double size : {1., 10.}) {
    const KnownProblem problem = variablesOfAllSizes(size);
    KnownNlp nlp(problem);
    const SolverResult result = solveSequentialQuadratic(nlp, problem.start, exact());
    EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
    EXPECT_NEAR(result.f, problem.cost, 1e-8);
    EXPECT_LE(result.violation, 1e-8);
    EXPECT_TRUE(near(result.x.cwiseQuotient(problem.optimum), VectorXd::Ones(6), 1e-2)) << result.x.transpose();
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
