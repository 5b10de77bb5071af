#include "kinegraph/solvers/interface/result.h"

#include <gtest/gtest.h>

using namespace kinegraph;

TEST(SolverResult, PrintsAsScriptsKnowIt) {
  EXPECT_EQ(SolverResult{}.str(),
            "{ time: 0, evals: 0, done: 0, feasible: 0, eq: 0, ineq: 0, sos: 0, f: 0, x-dim: [] }");
  SolverResult result;
  result.x.setZero(7);
  result.time = .000259;
  result.evals = 6;
  result.done = result.feasible = true;
  result.eq = .00184498;
  result.sos = .00337801;
  EXPECT_EQ(
      result.str(),
      "{ time: 0.000259, evals: 6, done: 1, feasible: 1, eq: 0.00184498, ineq: 0, sos: 0.00337801, f: 0, x-dim: [7] }");
}
