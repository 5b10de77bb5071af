#include "kinegraph/control/active_set.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "kinegraph/common/random.h"

using namespace kinegraph;

namespace {

constexpr double kExact = 1e-9;

/// The conditions that only the solution meets (Karush, Kuhn, Tucker).
void expectOptimal(const ActiveSet& model, const Eigen::MatrixXd& H, const Eigen::VectorXd& g, const Eigen::MatrixXd& A,
                   const Eigen::VectorXd& b) {
  const Eigen::VectorXd x = model.x();
  Eigen::VectorXd gradient = H * x + g;
  for (int i = 0; i < model.activeCount(); ++i) {
    const int row = model.active(i);
    EXPECT_NEAR(A.row(row).dot(x), b[row], kExact);
    EXPECT_GE(model.multiplier(i), -kExact);
    gradient -= model.multiplier(i) * A.row(row).transpose();
  }
  EXPECT_LT(gradient.cwiseAbs().maxCoeff(), kExact * (1. + g.cwiseAbs().maxCoeff()));
  EXPECT_GT((A * x - b).minCoeff(), -kExact);
}

}  // namespace

TEST(ActiveSet, ACornerOfABoxIsFound) {
  ActiveSet model;
  model.resize(2, 2);
  model.hessian().setIdentity();
  model.gradient() << 1., 2.;  // the free minimum is (-1, -2)
  model.addRow(Eigen::Vector2d(1., 0.), -.5);
  model.addRow(Eigen::Vector2d(0., 1.), 3.);
  ASSERT_TRUE(model.solve());
  EXPECT_EQ(model.x(), Eigen::Vector2d(-.5, 3.));
  EXPECT_EQ(model.activeCount(), 2);
}

TEST(ActiveSet, RandomProgramsMeetTheConditionsOfASolution) {
  Rng rng(1);
  ActiveSet model;
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
    model.resize(n, 41);
    model.hessian() = H, model.gradient() = g;
    for (int r = 0; r < m; ++r) model.addRow(A.row(r).transpose(), b[r]);
    ASSERT_TRUE(model.solve()) << round;
    expectOptimal(model, H, g, A, b);
  }
}

TEST(ActiveSet, RowsThatContradictEachOtherAreNoticed) {
  ActiveSet model;
  model.resize(2, 3);
  model.hessian().setIdentity();
  model.gradient().setZero();
  model.addRow(Eigen::Vector2d(1., 1.), 1.);
  model.addRow(Eigen::Vector2d(-1., 0.), 0.);
  model.addRow(Eigen::Vector2d(0., -1.), 0.);
  EXPECT_FALSE(model.solve());
}
