#include "kinegraph/solvers/nlp_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "kinegraph/nlp/problems.h"
#include "tests/solvers/hock_schittkowski.h"
#include "tests/support/expect_error.h"
#include "tests/support/near.h"

using namespace kinegraph;

namespace {

using enum ObjectiveType;
using M = OptMethod;

KnownProblem byName(const std::string& name) {
  for (const KnownProblem& problem : knownProblems()) {
    if (problem.name == name) return problem;
  }
  throw std::runtime_error(name);
}

/// As the table of methods says.
bool takesConstraints(M method) {
  const auto row = std::ranges::find(kOptMethods, method, &OptMethodName::method);
  return !std::string_view(row->doc).ends_with("No constraints.");
}

bool minimizesCosts(M method) { return method != M::slackGN; }

VectorXd vec2(double a, double b) { return Eigen::Vector2d(a, b); }

SolverOptions precise(M method) {
  SolverOptions options;
  options.verbose = 0;
  options.method = method;
  options.stopTolerance = 1e-6;
  options.stopEvals = 20000;
  return options;
}

/// sum_i w_i (x_i - c_i)^2 in a box, as sos rows; its optimum is c, clipped.
CallbackNlp diagonalQuadratic(const VectorXd& c, double low, double high) {
  const int n = int(c.size());
  return CallbackNlp(n, std::vector<ObjectiveType>(n, sos), VectorXd::Constant(n, low), VectorXd::Constant(n, high),
                     [c, n](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
                       for (int i = 0; i < n; ++i) {
                         const double w = 1. + i;
                         phi[i] = w * (x[i] - c[i]);
                         J(i, i) = w;
                       }
                     });
}

/// f(x) = sum of cosh(x_i - i): one f row, without a Hessian.
CallbackNlp smoothCost(int n) {
  return CallbackNlp(n, {f}, {}, {}, [n](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi[0] = 0.;
    for (int i = 0; i < n; ++i) {
      phi[0] += std::cosh(x[i] - i);
      J(0, i) = std::sinh(x[i] - i);
    }
  });
}

class Method : public ::testing::TestWithParam<M> {
 protected:
  M method() const { return GetParam(); }
};

}  // namespace

TEST_P(Method, FindsTheMinimumOfRosenbrocksValley) {
  if (!minimizesCosts(method())) GTEST_SKIP() << "costs do not matter to it";
  KnownNlp nlp(byName("Rosenbrock"));
  SolverOptions options = precise(method());
  options.stopEvals = 200000;
  const SolverResult result = solve(nlp, vec2(-1.2, 1.), options);
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_TRUE(near(result.x, vec2(1., 1.), method() == M::gradientDescent ? 2e-2 : 1e-3))
      << result.x.transpose() << " after " << result.evals;
}

TEST_P(Method, StopsAtTheBoundsOfAQuadratic) {
  if (!minimizesCosts(method())) GTEST_SKIP() << "costs do not matter to it";
  const VectorXd c = (VectorXd(5) << .3, -4., .1, 7., -.2).finished();
  CallbackNlp nlp = diagonalQuadratic(c, -1., 2.);
  const SolverResult result = solve(nlp, VectorXd::Constant(5, .5), precise(method()));
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_TRUE(near(result.x, c.cwiseMax(-1.).cwiseMin(2.), 2e-3)) << result.x.transpose();
  EXPECT_TRUE((result.x.array() >= -1.).all() && (result.x.array() <= 2.).all()) << "exactly";
}

TEST_P(Method, MinimizesASmoothFunction) {
  if (!minimizesCosts(method())) GTEST_SKIP() << "costs do not matter to it";
  CallbackNlp nlp = smoothCost(4);
  const SolverResult result = solve(nlp, VectorXd::Zero(4), precise(method()));
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_NEAR(result.f, 4., 1e-5);
}

TEST_P(Method, TakesConstraintsOrSaysThatItDoesNot) {
  for (const char* name : {"HS6", "HS14", "HS43"}) {
    const KnownProblem problem = byName(name);
    KnownNlp nlp(problem);
    SolverOptions options = precise(method());
    if (method() == M::squaredPenalty) options.stopGTolerance = 1e-5;  // it would take an infinite weight to reach zero
    if (!takesConstraints(method())) {
      expectError<ValueError>([&] { solve(nlp, problem.start, options); },
                              {optMethodName(method()).c_str(), "does not support constraints", "augmentedLag"});
      continue;
    }
    if (method() == M::logBarrier && std::string(name) == "HS14") {
      expectError<ValueError>([&] { solve(nlp, problem.start, options); }, {"strictly fulfills", "slackGN_logBarrier"});
      continue;
    }
    const SolverResult result = solve(nlp, problem.start, options);
    if (method() == M::singleSquaredPenalty) {
      EXPECT_LE(result.f + result.sos, problem.cost + 1e-6) << "violation buys cost";
      continue;
    }
    EXPECT_LE(result.violation, options.constraintTolerance()) << name << ": " << result.message;
    if (method() == M::slackGN) continue;
    EXPECT_NEAR(result.f + result.sos, problem.cost, 2e-3 * std::max(1., std::abs(problem.cost)))
        << name << ": " << result.message;
  }
}

TEST_P(Method, IsTheSameEveryTime) {
  CallbackNlp nlp = diagonalQuadratic(VectorXd::LinSpaced(4, -1., 2.), -1.5, 1.5);
  const SolverResult first = solve(nlp, VectorXd::Zero(4), precise(method())),
                     second = solve(nlp, VectorXd::Zero(4), precise(method()));
  EXPECT_EQ(first.x, second.x);
  EXPECT_EQ(first.evals, second.evals);
}

TEST_P(Method, EndsWhenTheCallerSaysSoAndGivesTheBestSoFar) {
  const KnownProblem problem = byName(takesConstraints(method()) ? "HS6" : "Rosenbrock");
  KnownNlp nlp(problem);
  int calls = 0;
  const SolverResult result =
      solve(nlp, problem.start, precise(method()), {}, [&](const VectorXd&, const VectorXd&) { return ++calls < 2; });
  EXPECT_EQ(result.status, SolverStatus::cancelled) << result.message;
  EXPECT_LE(calls, 3) << "a simplex or a population may end its round";
  EXPECT_EQ(result.x.size(), problem.start.size());
  EXPECT_TRUE(result.done);
}

TEST_P(Method, KeepsTheLimitOfEvaluations) {
  const KnownProblem problem = byName(takesConstraints(method()) ? "HS43" : "Rosenbrock");
  KnownNlp nlp(problem);
  SolverOptions options = precise(method());
  options.stopEvals = 4;
  const SolverResult result = solve(nlp, problem.start, options);
  EXPECT_LE(result.evals, 4);
  if (method() != M::slackGN) EXPECT_EQ(result.status, SolverStatus::limit) << result.message;
}

TEST_P(Method, NamesWhatIsNotANumber) {
  CallbackNlp nlp(2, {sos, sos}, {}, {}, [](const VectorXd&, VectorXd& phi, MatrixXd&) { phi << 1., std::nan(""); });
  expectError<ValueError>([&] { solve(nlp, VectorXd::Zero(2), precise(method())); }, {"row 1 (sos)", "nan"});
}

INSTANTIATE_TEST_SUITE_P(Methods, Method, ::testing::ValuesIn(availableMethods()),
                         [](const auto& info) { return optMethodName(info.param); });

TEST(Methods, ThoseThatAreNotThereAreRefusedWithTheNamesOfThoseThatAre) {
  CallbackNlp nlp = smoothCost(2);
  for (M method : {M::none, M::Ceres, M::LSBO, M::greedy, M::ES}) {
    expectError<ValueError>([&] { solve(nlp, VectorXd::Zero(2), precise(method)); },
                            {"not available", "augmentedLag", "NelderMead"});
  }
}

TEST(Methods, AMissingJacobianIsReplacedByDifferences) {
  CallbackNlp nlp(2, {sos, sos, eq}, {}, {}, [](const VectorXd& x, VectorXd& phi, MatrixXd&) {
    phi << x[0] - 1., x[1] + 2., std::sin(x[0]) - x[1];  // no J
  });
  SolverOptions options = precise(M::augmentedLag);
  options.finiteDifference = 1e-5;
  const SolverResult result = solve(nlp, VectorXd::Zero(2), options);
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_NEAR(std::sin(result.x[0]), result.x[1], 1e-6);
  EXPECT_NEAR((result.x[0] - 1.) + std::cos(result.x[0]) * (result.x[1] + 2.), 0., 1e-4)
      << "stationary along the curve";
}

TEST(Methods, TheCovarianceFollowsAnIllConditionedValley) {
  // condition number 1e6: isotropic steps would need far more evaluations
  CallbackNlp nlp(5, std::vector<ObjectiveType>(5, sos), {}, {}, [](const VectorXd& x, VectorXd& phi, MatrixXd&) {
    for (int i = 0; i < 5; ++i) phi[i] = std::pow(10., .75 * i) * (x[i] + x[(i + 1) % 5] - 1.);
  });
  SolverOptions options = precise(M::CMA);
  options.stopEvals = 6000;
  const SolverResult result = solve(nlp, VectorXd::Zero(5), options);
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_LT(result.sos, 1e-8);
}
