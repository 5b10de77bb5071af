#include "kinegraph/nlp/problems.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kinegraph/nlp/finite_difference_nlp.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "tests/solvers/numbers.h"
#include "tests/support/expect_error.h"
#include "tests/support/near.h"

using namespace kinegraph;

namespace {

using M = OptMethod;

SolverResult solveFrom(const std::string& name, const VectorXd& start, M method = M::augmentedLag) {
  const auto nlp = makeTestProblem(name, {int(start.size())});
  SolverOptions options;
  options.method = method;
  options.verbose = 0;
  options.stopEvals = 20000;
  options.stopTolerance = options.stopGTolerance = 1e-8;
  return solve(*nlp, start, options);
}

}  // namespace

TEST(TestProblems, HaveTheDerivativesThatTheyClaim) {
  for (const std::string& name : testProblemNames()) {
    for (int n : {2, 5}) {
      if (name == "Himmelblau" && n != 2) continue;
      const auto nlp = makeTestProblem(name, {n, 3});
      Rng rng(5);
      for (int sample = 0; sample < 5; ++sample) {
        const VectorXd x = nlp->uniformPoint(rng);
        EXPECT_LT(checkJacobian(*nlp, x).error, 1e-6) << name;
        if (name != "Ackley") EXPECT_LT(checkHessian(*nlp, x).error, 1e-5) << name;
      }
    }
  }
}

TEST(TestProblems, ConvexOnesAreSolved) {
  EXPECT_LT(solveFrom("square", vec({1., -1., .5})).sos, 1e-12);
  const SolverResult wedge = solveFrom("Wedge", vec({1., .5}));
  EXPECT_TRUE(near(wedge.x, vec({-.4, -.4}), 1e-7)) << wedge.message;
  EXPECT_NEAR(wedge.f, -.8, 1e-7);
  const SolverResult half_circle = solveFrom("HalfCircle", vec({.3, .1}));
  EXPECT_TRUE(near(half_circle.x, vec({-.2, -std::sqrt(.25 - .04)}), 1e-6)) << half_circle.message;
  EXPECT_NEAR(half_circle.f, -.6582576, 1e-6);
  EXPECT_LT(solveFrom("Box", vec({1.8, -1.9})).ineq, 1e-8);
}

TEST(TestProblems, ALinearProgramEndsAtItsBestCorner) {
  for (std::uint64_t seed : {0, 1, 2}) {
    const auto nlp = makeTestProblem("LinearProgram", {2, seed});
    SolverOptions options;
    options.verbose = 0;
    options.stopTolerance = options.stopGTolerance = 1e-8;
    const SolverResult result = solve(*nlp, vec({0., 0.}), options);
    // all corners: of two constraints or bounds
    Jacobian J = nlp->makeJacobian();
    VectorXd phi(16);
    nlp->evaluate(vec({0., 0.}), phi, &J);
    MatrixXd rows(19, 2);
    VectorXd right(19);
    rows << J.toDense().bottomRows(15), MatrixXd::Identity(2, 2), -MatrixXd::Identity(2, 2);
    right << -phi.tail(15), 2., 2., 2., 2.;
    double best = 1e9;
    for (int a = 0; a < 19; ++a) {
      for (int b = 0; b < a; ++b) {
        Eigen::Matrix2d corner;
        corner << rows.row(a), rows.row(b);
        if (std::abs(corner.determinant()) < 1e-9) continue;
        const Eigen::Vector2d x = corner.inverse() * Eigen::Vector2d(right[a], right[b]);
        if ((rows * x - right).maxCoeff() < 1e-9) best = std::min(best, J.toDense().row(0).dot(x));
      }
    }
    EXPECT_NEAR(result.f, best, 1e-6) << "seed " << seed << ": " << result.message;
    EXPECT_LE(result.violation, 1e-7);
  }
}

TEST(TestProblems, SmoothOnesAreSolvedByEveryMethodThatTakesThem) {
  for (M method : {M::augmentedLag, M::newton, M::LBFGS}) {
    const SolverResult rosenbrock = solveFrom("Rosenbrock", vec({-1.2, 1.}), method),
                       himmelblau = solveFrom("Himmelblau", vec({1., 1.}), method);
    EXPECT_TRUE(near(rosenbrock.x, vec({1., 1.}), 1e-4)) << optMethodName(method) << ": " << rosenbrock.message;
    EXPECT_TRUE(near(himmelblau.x, vec({3., 2.}), 1e-5)) << optMethodName(method) << ": " << himmelblau.message;
    EXPECT_TRUE(near(solveFrom("Rastrigin", vec({.2, -.1}), method).x, vec({0., 0.}), 1e-5)) << optMethodName(method);
  }
}

TEST(TestProblems, ManyMinimaAreNoTrapForAPopulation) {
  const SolverResult ackley = solveFrom("Ackley", vec({1.3, -1.7}), M::CMA);
  EXPECT_LT(ackley.x.norm(), 1e-6) << ackley.message;
  const SolverResult rugged = solveFrom("Rugged", vec({0., 0.}), M::CMA);
  EXPECT_LT(rugged.sos, .02) << "of heights between 0 and 1: " << rugged.message;
}

TEST(TestProblems, ModesAreFeasibleInBallsOnly) {
  const auto nlp = makeTestProblem("Modes");
  VectorXd phi(1);
  for (const auto& [x, expected] :
       {std::pair{vec({0., 0.}), -.5}, {vec({1., -1.}), -.1}, {vec({1., -1.05}), -.05}, {vec({.6, 0.}), .1}}) {
    nlp->evaluate(x, phi, nullptr);
    EXPECT_NEAR(phi[0], expected, 1e-12);
  }
}

TEST(TestProblems, SpheresComeToRestOnTheGroundWithoutOverlap) {
  const auto nlp = makeTestProblem("SpherePacking", {6});
  Rng rng(1);
  SolverOptions options;
  options.verbose = 0;
  const SolverResult result = solve(*nlp, nlp->uniformPoint(rng), options);
  EXPECT_TRUE(result.feasible) << result.message;
  EXPECT_NEAR(result.f, 6 * .21, 1e-3) << "all six lie on the ground";
  EXPECT_EQ(makeTestProblem("SpherePacking")->dimension(), 150);
  EXPECT_EQ(makeTestProblem("SpherePacking")->types().size(), 50u + 1225u);
}

TEST(TestProblems, AreTheSameForTheSameSeed) {
  for (const char* name : {"square", "Rugged", "LinearProgram"}) {
    VectorXd values[3];
    for (int i = 0; i < 3; ++i) {
      const auto nlp = makeTestProblem(name, {3, std::uint64_t(i / 2)});
      nlp->evaluate(vec({.1, .2, .3}), values[i], nullptr);
    }
    EXPECT_EQ(values[0], values[1]) << name;
    EXPECT_NE(values[0], values[2]) << name;
  }
}

TEST(TestProblems, NamesThatAreNotThereSayWhichAreNear) {
  expectError<NameError>([] { makeTestProblem("rosenbrok"); }, {"'rosenbrok'", "similar names: Rosenbrock"});
  expectError<ValueError>([] { makeTestProblem("Himmelblau", {3}); }, {"Himmelblau", "is 3", "expected 2"});
}
