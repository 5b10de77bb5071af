#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/nlp/problems.h"
#include "kinegraph/solvers/methods/augmented_lagrangian.h"

// Tests of the augmented Lagrangian on large problems, such as paths.

using namespace kinegraph;

namespace {

using enum ObjectiveType;

constexpr int kPairs = 60;

}  // namespace

/// Gauss-Newton knows about half of the curvature along x, and its steps go nearly as far beyond the least value as
/// they began before it.
TEST(ManyVariables, StepsThatOvershootAreDampedAtOnce) {
  // pairs (x, y) on the parabola y = .02 x^2, with costs that pull x to 1 and y to -10
  std::vector<ObjectiveType> types(std::size_t(2 * kPairs), sos);
  types.insert(types.end(), std::size_t(kPairs), eq);
  CallbackNlp nlp(2 * kPairs, types, {}, {}, [](const VectorXd& z, VectorXd& phi, MatrixXd& J) {
    phi.resize(3 * kPairs);
    J.setZero(3 * kPairs, 2 * kPairs);
    for (int i = 0; i < kPairs; ++i) {
      const double x = z[i], y = z[kPairs + i];
      phi[i] = .45 * (x - 1.);
      phi[kPairs + i] = y + 10.;
      phi[2 * kPairs + i] = y - .02 * x * x;
      J(i, i) = .45;
      J(kPairs + i, kPairs + i) = J(2 * kPairs + i, kPairs + i) = 1.;
      J(2 * kPairs + i, i) = -.04 * x;
    }
  });
  VectorXd start(2 * kPairs);
  for (int i = 0; i < 2 * kPairs; ++i) start[i] = 6. * std::sin(1. + i);
  const SolverResult result = solveAugmentedLagrangian(nlp, start, SolverOptions{});
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  for (int i = 0; i < kPairs; ++i) {
    const double x = result.x[i];
    EXPECT_NEAR(.45 * .45 * (x - 1.) + (.02 * x * x + 10.) * .04 * x, 0., 1e-3)
        << "half of the gradient along the parabola";
  }
  EXPECT_LE(result.evals, 35);
}

/// Rows of a tenth need a penalty in the hundreds; the model shows that without an evaluation.
TEST(ManyVariables, PenaltiesAreRaisedAsTheModelAsks) {
  constexpr int n = 2 * kPairs;
  std::vector<ObjectiveType> types(std::size_t(n), sos);
  types.insert(types.end(), std::size_t(n), eq);
  CallbackNlp nlp(n, types, {}, {}, [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi.resize(2 * n);
    phi << 3. * x, .1 * (x.array() + x.array().square() - 2.).matrix();
    J.setZero(2 * n, n);
    J.diagonal().setConstant(3.);
    J.bottomRows(n).diagonal() = (.1 * (1. + 2. * x.array())).matrix();
  });
  const SolverResult result = solveAugmentedLagrangian(nlp, VectorXd::Zero(n), SolverOptions{});
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  for (double x : result.x) EXPECT_NEAR(x, 1., 1e-3);
  EXPECT_LE(result.evals, 9);
}
