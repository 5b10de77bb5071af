#include "kinegraph/solvers/algebra/quadratic_program.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"
#include "tests/solvers/numbers.h"
#include "tests/support/near.h"

namespace kinegraph {

namespace {

/// A program that x and the multipliers solve, as they fulfil the first-order conditions of a convex problem.
struct Known {
  QuadraticProgram model;
  VectorXd x, multipliers;
};

Known knownModel(int n, int equalities, int active, int inactive, Rng& rng) {
  Known known;
  QuadraticProgram& p = known.model;
  const MatrixXd root = randomMatrix(n, n, rng);
  p.H = root * root.transpose() + .1 * MatrixXd::Identity(n, n);
  const int m = equalities + active + inactive;
  p.A = randomMatrix(m, n, rng);
  p.equalities = equalities;
  known.x = randomMatrix(n, 1, rng);
  known.multipliers = VectorXd::Zero(m);
  VectorXd slack = VectorXd::Zero(m);
  for (int j = 0; j < equalities + active; ++j)
    known.multipliers[j] = j < equalities ? rng.normal() : rng.uniform(.1, 2.);
  for (int j = equalities + active; j < m; ++j) slack[j] = rng.uniform(.1, 2.);
  p.b = -p.A * known.x - slack;
  p.g = -p.H * known.x - p.A.transpose() * known.multipliers;
  return known;
}

}  // namespace

TEST(QuadraticProgram, IsSolvedWithItsMultipliers) {
  Rng rng(1);
  for (int n : {1, 2, 5, 12}) {
    for (int trial = 0; trial < 20; ++trial) {
      const int equalities = trial % (n + 1), active = (n - equalities) / 2;
      const Known known = knownModel(n, equalities, active, 2 * n, rng);
      const QuadraticSolution solution = solve(known.model);
      ASSERT_EQ(solution.status, QuadraticStatus::solved) << "n " << n << " trial " << trial;
      EXPECT_TRUE(near(solution.x, known.x, 1e-8));
      EXPECT_TRUE(near(solution.multipliers, known.multipliers, 1e-6));
    }
  }
}

TEST(QuadraticProgram, WithoutRowsIsOneLinearSystem) {
  Rng rng(2);
  const Known known = knownModel(6, 0, 0, 0, rng);
  EXPECT_TRUE(near(solve(known.model).x, known.x, 1e-9));
}

TEST(QuadraticProgram, TakesRowsThatDependOnOthers) {
  Rng rng(3);
  Known known = knownModel(4, 2, 1, 3, rng);
  QuadraticProgram twice = known.model;  // every row two times, equalities first
  twice.equalities = 4;
  twice.A.resize(12, 4);
  twice.b.resize(12);
  for (int j = 0; j < 6; ++j) {
    const int first = j < 2 ? 2 * j : 4 + 2 * (j - 2);
    twice.A.row(first) = twice.A.row(first + 1) = known.model.A.row(j);
    twice.b[first] = twice.b[first + 1] = known.model.b[j];
  }
  const QuadraticSolution solution = solve(twice);
  ASSERT_EQ(solution.status, QuadraticStatus::solved);
  EXPECT_TRUE(near(solution.x, known.x, 1e-8));
}

TEST(QuadraticProgram, TellsThatItsConstraintsContradictEachOther) {
  QuadraticProgram model;  // x <= -1 and x >= 1
  model.H = MatrixXd::Identity(1, 1);
  model.g = VectorXd::Zero(1);
  model.A = (MatrixXd(2, 1) << 1., -1.).finished();
  model.b = VectorXd::Ones(2);
  EXPECT_EQ(solve(model).status, QuadraticStatus::infeasible);
  model.equalities = 2;  // x = -1 and x = 1
  EXPECT_EQ(solve(model).status, QuadraticStatus::infeasible);
}

TEST(QuadraticProgram, TellsThatItIsNotConvex) {
  QuadraticProgram model;
  model.H = -MatrixXd::Identity(2, 2);
  model.g = VectorXd::Zero(2);
  model.A = MatrixXd::Zero(0, 2);
  EXPECT_EQ(solve(model).status, QuadraticStatus::notConvex);
}

}  // namespace kinegraph
