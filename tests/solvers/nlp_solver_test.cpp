#include "kinegraph/solvers/nlp_solver.h"

#include <gtest/gtest.h>

#include "tests/solvers/hock_schittkowski.h"
#include "tests/support/expect_error.h"
#include "tests/support/near.h"

using namespace kinegraph;

namespace {

KnownProblem byName(const char* name) {
  for (const KnownProblem& problem : knownProblems()) {
    if (problem.name == name) return problem;
  }
  throw std::runtime_error(name);
}

NlpSolver quiet(const KnownProblem& problem) { return NlpSolver(std::make_shared<KnownNlp>(problem), 0); }

}  // namespace

TEST(NlpSolver, ASecondSolveGoesOnFromTheFirst) {
  const KnownProblem problem = byName("HS43");
  NlpSolver solver = quiet(problem);
  solver.setInitialization(problem.start);
  Rng rng(0);
  const SolverResult first = solver.solve(false, rng), second = solver.solve(false, rng);
  EXPECT_TRUE(near(first.x, problem.optimum, 1e-3));
  EXPECT_LE(second.evals, 3);
  EXPECT_EQ(first.totalEvals, first.evals);
  EXPECT_EQ(second.totalEvals, first.evals + second.evals);
  EXPECT_TRUE(near(second.x, problem.optimum, 1e-3));
}

TEST(NlpSolver, SolvesInMemoryThatItHasUsedAsInNewMemory) {
  for (const KnownProblem& problem : knownProblems()) {
    NlpSolver solver = quiet(problem);
    Rng rng(0);
    solver.setInitialization(problem.start);
    const SolverResult first = solver.solve(false, rng);
    solver.setInitialization(problem.start + VectorXd::Constant(problem.start.size(), .1));
    const SolverResult other = solver.solve(false, rng);
    solver.setInitialization(problem.start);
    const SolverResult again = solver.solve(false, rng);
    EXPECT_EQ(again.x, first.x) << problem.name;
    EXPECT_EQ(again.dual, first.dual) << problem.name;
    EXPECT_EQ(again.evals, first.evals) << problem.name;
    EXPECT_EQ(again.totalEvals, first.evals + other.evals + again.evals) << problem.name;
  }
}

TEST(NlpSolver, StartsAfreshFromAnInitializationOrASample) {
  const KnownProblem problem = byName("HS71");
  NlpSolver solver = quiet(problem);
  solver.setTracing(true, false, false);
  Rng rng(1);
  solver.solve(false, rng);
  const VectorXd first_start = solver.traceX().front();
  EXPECT_TRUE((first_start.array() >= 1.).all() && (first_start.array() <= 5.).all());
  solver.clearTracing();
  solver.solve(true, rng);
  EXPECT_NE(solver.traceX().front(), first_start);
  solver.clearTracing();
  solver.setInitialization(problem.start);
  solver.solve(false, rng);
  EXPECT_EQ(solver.traceX().front(), problem.start);
}

TEST(NlpSolver, TracesEveryEvaluation) {
  const KnownProblem problem = byName("HS14");
  NlpSolver solver = quiet(problem);
  solver.setInitialization(problem.start);
  solver.setTracing(true, true, true);
  Rng rng(0);
  const SolverResult result = solver.solve(false, rng);
  EXPECT_EQ(int(solver.traceX().size()), result.evals);
  EXPECT_EQ(int(solver.tracePhi().size()), result.evals);
  EXPECT_EQ(int(solver.traceErrors().size()), result.evals);
  EXPECT_EQ(solver.traceErrors().front().sos, 1.) << "at (2, 2)";
  EXPECT_EQ(solver.tracePhi().front()[2], 4.);
}

TEST(NlpSolver, StopsWhenAskedTo) {
  NlpSolver solver = quiet(byName("Rosenbrock"));
  Rng rng(0);
  int asked = 0;
  const SolverResult result = solver.solve(false, rng, [&](const VectorXd&, const VectorXd&) { return ++asked < 3; });
  EXPECT_EQ(result.status, SolverStatus::cancelled);
  EXPECT_EQ(result.evals, 3);
}

TEST(NlpSolver, ProgressIsToldAndMayStopIt) {
  NlpSolver solver = quiet(byName("Rosenbrock"));
  Rng rng(0);
  std::vector<int> evals;
  solver.setProgress(
      [&](int count, const VectorXd& x, const ErrorSums& errors) {
        EXPECT_EQ(x.size(), 2);
        EXPECT_GE(errors.sos, 0.);
        evals.push_back(count);
        return count < 5;
      },
      0.);
  EXPECT_EQ(solver.solve(false, rng).status, SolverStatus::cancelled);
  EXPECT_EQ(evals, (std::vector<int>{1, 2, 3, 4, 5}));
  solver.setProgress([&](int, const VectorXd&, const ErrorSums&) { return false; }, 1e9);
  EXPECT_EQ(solver.solve(true, rng).status, SolverStatus::converged) << "it is not the time to tell yet";
}

TEST(NlpSolver, TracesJacobians) {
  NlpSolver solver = quiet(byName("HS6"));
  solver.setInitialization(Eigen::Vector2d(2., 1.));
  solver.setTracing(true, false, false, true);
  Rng rng(0);
  const SolverResult result = solver.solve(false, rng);
  ASSERT_EQ(int(solver.traceJacobian().size()), result.evals);
  EXPECT_TRUE(near(solver.traceJacobian().front(), (MatrixXd(2, 2) << -1., 0., -40., 10.).finished(), 1e-12));
}

TEST(NlpSolver, MethodsCanBeAdded) {
  const KnownProblem problem = byName("HS6");
  NlpSolver solver = quiet(problem);
  solver.addMethod(OptMethod::Ipopt, [&](Nlp& nlp, const VectorXd&, const SolverOptions&, const EvaluationCallback&) {
    SolverResult result;
    result.x = problem.optimum;
    VectorXd phi(Eigen::Index(nlp.types().size()));
    nlp.evaluate(result.x, phi, nullptr);
    result.setSums(nlp.types(), phi, 1e-6);
    return result;
  });
  solver.options.method = OptMethod::Ipopt;
  Rng rng(0);
  EXPECT_TRUE(near(solver.solve(false, rng).x, problem.optimum, 0.));
}

TEST(NlpSolver, MistakesAreExplained) {
  Rng rng(0);
  NlpSolver none;
  expectError([&] { none.solve(false, rng); }, {"no problem"});
  NlpSolver solver = quiet(byName("HS6"));
  expectError([&] { solver.setProblem(solver.problem()); }, {"already"});
  expectError<ValueError>([&] { solver.setInitialization(VectorXd::Zero(5)); }, {"5 entries", "2 variables"});
  solver.options.method = OptMethod::Ipopt;
  expectError<ValueError>([&] { solver.solve(false, rng); }, {"Ipopt", "not available", "augmentedLag"});
}

TEST(NlpSolver, TakesMultipliersThatAreSet) {
  const KnownProblem problem = byName("HS43");
  NlpSolver cold = quiet(problem), warm = quiet(problem);
  Rng rng(0);
  cold.setInitialization(problem.start);
  const SolverResult first = cold.solve(false, rng);
  warm.setInitialization(first.x);
  warm.dual = first.dual;
  EXPECT_LE(warm.solve(false, rng).evals, 3);
}
