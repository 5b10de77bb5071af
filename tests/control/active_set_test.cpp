#include "kinegraph/control/active_set.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "kinegraph/common/random.h"

using namespace kinegraph;

namespace {

constexpr double kExact = 1e-9;

/// The conditions that only the solution meets (Karush, Kuhn, Tucker).
void expectOptimal(const ActiveSet& program, const Eigen::MatrixXd& H, const Eigen::VectorXd& g,
                   const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  const Eigen::VectorXd x = program.x();
  Eigen::VectorXd gradient = H * x + g;
  for (int i = 0; i < program.activeCount(); ++i) {
    const int row = program.active(i);
    EXPECT_NEAR(A.row(row).dot(x), b[row], kExact);
    EXPECT_GE(program.multiplier(i), -kExact);
    gradient -= program.multiplier(i) * A.row(row).transpose();
  }
  EXPECT_LT(gradient.cwiseAbs().maxCoeff(), kExact * (1. + g.cwiseAbs().maxCoeff()));
  EXPECT_GT((A * x - b).minCoeff(), -kExact);
}

}  // namespace

TEST(ActiveSet, ACornerOfABoxIsFound) {
  ActiveSet program;
  program.resize(2, 2);
  program.hessian().setIdentity();
  program.gradient() << 1., 2.;  // the free minimum is (-1, -2)
  program.addRow(Eigen::Vector2d(1., 0.), -.5);
  program.addRow(Eigen::Vector2d(0., 1.), 3.);
  ASSERT_TRUE(program.solve());
  EXPECT_EQ(program.x(), Eigen::Vector2d(-.5, 3.));
  EXPECT_EQ(program.activeCount(), 2);
}

TEST(ActiveSet, RandomProgramsMeetTheConditionsOfASolution) {
  Rng rng(1);
  ActiveSet program;
  for (int round = 0; round < 400; ++round) {
    const int n = 1 + round % 9, m = 1 + round % 40;
    Eigen::MatrixXd M(n, n), A(m, n);
    Eigen::VectorXd g(n), b(m), inside(n);
    for (int i = 0; i < n; ++i) {
      g[i] = rng.uniform(-3., 3.), inside[i] = rng.uniform(-1., 1.);
      for (int j = 0; j < n; ++j) M(i, j) = rng.uniform(-1., 1.);
    }
    for (int r = 0; r < m; ++r) {
      for (int j = 0; j < n; ++j) A(r, j) = rng.uniform(-1., 1.);
      b[r] = A.row(r).dot(inside) - rng.uniform(0., .2);
    }
    const Eigen::MatrixXd H = M * M.transpose() + .01 * Eigen::MatrixXd::Identity(n, n);
    program.resize(n, 41);
    program.hessian() = H, program.gradient() = g;
    for (int r = 0; r < m; ++r) program.addRow(A.row(r).transpose(), b[r]);
    ASSERT_TRUE(program.solve()) << round;
    expectOptimal(program, H, g, A, b);
  }
}

TEST(ActiveSet, RowsThatContradictEachOtherAreNoticed) {
  ActiveSet program;
  program.resize(2, 3);
  program.hessian().setIdentity();
  program.gradient().setZero();
  program.addRow(Eigen::Vector2d(1., 1.), 1.);
  program.addRow(Eigen::Vector2d(-1., 0.), 0.);
  program.addRow(Eigen::Vector2d(0., -1.), 0.);
  EXPECT_FALSE(program.solve());
}
