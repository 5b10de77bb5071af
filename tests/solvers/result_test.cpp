#include "kinegraph/solvers/result.h"

#include <gtest/gtest.h>

#include "kinegraph/nlp/callback_nlp.h"

using namespace kinegraph;

TEST(SolverResult, PrintsAsScriptsKnowIt) {
  EXPECT_EQ(SolverResult{}.str(), "{ time: 0, evals: 0, done: 0, feasible: 0, eq: 0, ineq: 0, sos: 0, f: 0, x-dim: [] }");
  SolverResult result;
  result.x.setZero(7);
  result.time = .000259;
  result.evals = 6;
  result.done = result.feasible = true;
  result.eq = .00184498;
  result.sos = .00337801;
  EXPECT_EQ(result.str(), "{ time: 0.000259, evals: 6, done: 1, feasible: 1, eq: 0.00184498, ineq: 0, sos: 0.00337801, f: 0, x-dim: [7] }");
}

TEST(Explain, NamesTheViolatedConstraintsWorstFirst) {
  using enum ObjectiveType;
  const CallbackNlp nlp(1, {sos, eq, ineq, ineq, eq}, {}, {}, [](const VectorXd&, VectorXd&, MatrixXd&) {});
  const VectorXd phi = (VectorXd(5) << 9., .25, -7., .5, 1e-5).finished();
  EXPECT_EQ(explain(nlp, phi, 1e-3), "2 constraints are violated (scaled values):\n  row 3 (ineq): 0.5\n  row 1 (eq): 0.25");
  EXPECT_EQ(explain(nlp, phi, 1e-3, 1), "2 constraints are violated (scaled values):\n  row 3 (ineq): 0.5\n  and 1 more");
  EXPECT_EQ(explain(nlp, phi, .4), "1 constraint is violated (scaled values):\n  row 3 (ineq): 0.5");
  EXPECT_EQ(explain(nlp, phi, 1.), "All constraints hold to 1.");
}
