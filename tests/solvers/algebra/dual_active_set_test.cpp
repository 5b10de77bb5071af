#include "kinegraph/solvers/algebra/dual_active_set.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include "kinegraph/common/random.h"
#include "kinegraph/math/pose.h"
#include "tests/support/malloc_count.h"

namespace kinegraph {
namespace {

constexpr double kKktTolerance = 1e-9;

MatrixXd uniformMatrix(int rows, int columns, Rng& rng) {
  MatrixXd M(rows, columns);
  for (double& value : M.reshaped()) value = rng.uniform(-1., 1.);
  return M;
}

/// A program with normals in the rows of A; the first `equalities` constraints are equalities.
struct TestProgram {
  MatrixXd H, A;
  VectorXd g, b;
  int equalities = 0;

  void writeTo(DualActiveSet& model) const {
    model.resize(int(g.size()), int(b.size()));
    model.hessian() = H, model.gradient() = g;
    for (int i = 0; i < int(b.size()); ++i) {
      if (i < equalities)
        model.addEquality(A.row(i).transpose(), b[i]);
      else
        model.addInequality(A.row(i).transpose(), b[i]);
    }
  }
};

/// The largest violation of the conditions of Karush, Kuhn and Tucker, which only the solution meets.
double kktResidual(const DualActiveSet& model, const TestProgram& p) {
  const VectorXd& x = model.x();
  VectorXd gradient = p.H * x + p.g;
  double worst = 0.;
  for (int k = 0; k < model.activeCount(); ++k) {
    const int i = model.active(k);
    worst = std::max(worst, std::abs(p.A.row(i).dot(x) - p.b[i]));
    if (i >= p.equalities) worst = std::max(worst, -model.multiplier(k));
    gradient -= model.multiplier(k) * p.A.row(i).transpose();
  }
  for (int i = 0; i < p.b.size(); ++i) {
    const double missing = p.b[i] - p.A.row(i).dot(x);
    worst = std::max(worst, i < p.equalities ? std::abs(missing) : missing);
  }
  return std::max(worst, gradient.lpNorm<Eigen::Infinity>() / (1. + p.g.lpNorm<Eigen::Infinity>()));
}

/// A feasible program; its Hessian has eigenvalues of at least .01.
TestProgram feasibleProgram(int n, int equalities, int inequalities, Rng& rng) {
  TestProgram p;
  const MatrixXd M = uniformMatrix(n, n, rng);
  p.H = M * M.transpose() + .01 * MatrixXd::Identity(n, n);
  p.g = 3. * uniformMatrix(n, 1, rng);
  p.A = uniformMatrix(equalities + inequalities, n, rng);
  p.b = p.A * uniformMatrix(n, 1, rng);
  for (int i = equalities; i < p.b.size(); ++i) p.b[i] -= rng.uniform(0., .2);
  p.equalities = equalities;
  return p;
}

TEST(DualActiveSet, TheSolutionIsACornerOfABox) {
  DualActiveSet model;
  model.resize(2, 2);
  model.hessian().setIdentity();
  model.gradient() << 1., 2.;  // the unconstrained minimum is (-1, -2)
  model.addInequality(Eigen::Vector2d(1., 0.), -.5);
  model.addInequality(Eigen::Vector2d(0., 1.), 3.);
  ASSERT_EQ(model.solve(), QuadraticStatus::solved);
  EXPECT_EQ(model.x(), Eigen::Vector2d(-.5, 3.));
  EXPECT_EQ(model.activeCount(), 2);
}

TEST(DualActiveSet, TheSolutionOnALineIsTheProjection) {
  DualActiveSet model;
  model.resize(2, 2);
  model.hessian().setIdentity();
  model.gradient().setZero();
  model.addEquality(Eigen::Vector2d(1., 1.), 2.);     // nearest point (1, 1), multiplier 1
  model.addInequality(Eigen::Vector2d(1., 0.), 1.5);  // then (1.5, .5): x = 0.5 a_0 + 1 a_1
  ASSERT_EQ(model.solve(), QuadraticStatus::solved);
  EXPECT_NEAR((model.x() - Eigen::Vector2d(1.5, .5)).norm(), 0., 1e-15);
  ASSERT_EQ(model.activeCount(), 2);
  EXPECT_NEAR(model.multiplier(0), .5, 1e-15);
  EXPECT_NEAR(model.multiplier(1), 1., 1e-15);
}

TEST(DualActiveSet, EqualitiesHaveMultipliersOfBothSigns) {
  for (const double b : {-2., 2.}) {
    DualActiveSet model;
    model.resize(1, 1);
    model.hessian() << 4.;
    model.gradient() << 0.;
    model.addEquality(VectorXd::Ones(1), b);
    ASSERT_EQ(model.solve(), QuadraticStatus::solved);
    EXPECT_EQ(model.x()[0], b);
    EXPECT_EQ(model.multiplier(0), 4. * b);
  }
}

TEST(DualActiveSet, RandomProgramsMeetTheConditionsOfASolution) {
  Rng rng(1);
  DualActiveSet model;
  for (int round = 0; round < 400; ++round) {
    const int n = 1 + round % 9, equalities = round % 3 == 0 ? round % n : 0;
    const TestProgram p = feasibleProgram(n, equalities, 1 + round % 40, rng);
    p.writeTo(model);
    ASSERT_EQ(model.solve(), QuadraticStatus::solved) << round;
    EXPECT_LT(kktResidual(model, p), kKktTolerance) << round;
  }
}

TEST(DualActiveSet, DegenerateProgramsMeetTheConditionsOfASolution) {
  Rng rng(2);
  DualActiveSet model;
  for (int round = 0; round < 200; ++round) {
    const int n = 2 + round % 6;
    TestProgram p = feasibleProgram(n, round % 2, 4 * n, rng);
    const VectorXd corner = uniformMatrix(n, 1, rng);
    p.b = p.A * corner;  // all constraints meet in one point,
    for (int i = p.equalities + 1; i < p.b.size(); i += 3) {
      p.A.row(i) = rng.uniform(.5, 2.) * p.A.row(i - 1);  // and some are multiples of others
      p.b[i] = p.A.row(i).dot(corner);
    }
    p.writeTo(model);
    ASSERT_EQ(model.solve(), QuadraticStatus::solved) << round;
    EXPECT_LT(kktResidual(model, p), kKktTolerance) << round;
  }
}

TEST(DualActiveSet, RedundantEqualitiesAreIgnored) {
  Rng rng(3);
  const TestProgram once = feasibleProgram(4, 2, 6, rng);
  TestProgram twice = once;
  twice.A.resize(9, 4), twice.b.resize(9);
  twice.A << once.A.topRows(2), once.A.row(0) - 2. * once.A.row(1), once.A.bottomRows(6);
  twice.b << once.b.head(2), once.b[0] - 2. * once.b[1], once.b.tail(6);
  twice.equalities = 3;
  DualActiveSet one, other;
  once.writeTo(one), twice.writeTo(other);
  ASSERT_EQ(one.solve(), QuadraticStatus::solved);
  ASSERT_EQ(other.solve(), QuadraticStatus::solved);
  EXPECT_LT((one.x() - other.x()).norm(), kKktTolerance);
}

TEST(DualActiveSet, InfeasibleProgramsAreReported) {
  DualActiveSet model;
  model.resize(2, 3);
  model.hessian().setIdentity();
  model.gradient().setZero();
  model.addInequality(Eigen::Vector2d(1., 1.), 1.);
  model.addInequality(Eigen::Vector2d(-1., 0.), 0.);
  model.addInequality(Eigen::Vector2d(0., -1.), 0.);
  EXPECT_EQ(model.solve(), QuadraticStatus::infeasible);
  model.clear();
  model.addEquality(Eigen::Vector2d(1., 1.), 1.);
  model.addEquality(Eigen::Vector2d(2., 2.), 1.);
  EXPECT_EQ(model.solve(), QuadraticStatus::infeasible);
  Rng rng(4);
  for (int round = 0; round < 200; ++round) {
    TestProgram p = feasibleProgram(1 + round % 7, 0, 20, rng);
    p.A.row(7) = -p.A.row(3) * rng.uniform(.5, 2.);  // a_3' x >= b_3 and a_3' x <= b_3 - .1
    p.b[7] = p.A.row(7).norm() / p.A.row(3).norm() * (-p.b[3] + .1);
    p.writeTo(model);
    EXPECT_EQ(model.solve(), QuadraticStatus::infeasible) << round;
  }
}

TEST(DualActiveSet, AnIndefiniteHessianIsReported) {
  DualActiveSet model;
  model.resize(2, 0);
  model.hessian() << 1., 2., 2., 1.;
  model.gradient().setZero();
  EXPECT_EQ(model.solve(), QuadraticStatus::notConvex);
}

TEST(DualActiveSet, LaterProgramsOfTheSameSizeDoNotAllocate) {
  Rng rng(5);
  DualActiveSet model;
  const TestProgram first = feasibleProgram(7, 1, 30, rng), second = feasibleProgram(7, 2, 20, rng);
  first.writeTo(model);
  model.solve();
  const long before = heap_requests;
  second.writeTo(model);
  model.solve();
  EXPECT_EQ(heap_requests, before);
}

}  // namespace
}  // namespace kinegraph
