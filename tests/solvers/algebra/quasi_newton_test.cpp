#include "kinegraph/solvers/algebra/quasi_newton.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "kinegraph/common/random.h"
#include "tests/support/near.h"

using namespace kinegraph;

namespace {

VectorXd random(int n, Rng& rng) {
  VectorXd x(n);
  for (double& value : x) value = rng.normal();
  return x;
}

MatrixXd randomSymmetric(int n, Rng& rng) {
  MatrixXd A(n, n);
  for (double& value : A.reshaped()) value = rng.normal();
  return A + A.transpose();
}

}  // namespace

TEST(QuasiNewton, LearnsTheHessianOfAQuadratic) {
  Rng rng(0);
  const MatrixXd A = randomSymmetric(4, rng), H = A * A + MatrixXd::Identity(4, 4);
  QuasiNewton estimate;
  estimate.reset(4);
  for (int i = 0; i < 40; ++i) {
    const VectorXd s = random(4, rng), y = H * s;
    const bool plain = i == 0 || s.dot(y) > .2 * s.dot(estimate.matrix() * s);
    estimate.update(s, y);
    if (plain) {
      EXPECT_TRUE(near(estimate.matrix() * s, y, 1e-9)) << "it repeats the last change";
    }
  }
  EXPECT_LT((estimate.matrix() - H).norm(), .05 * H.norm());
}

TEST(QuasiNewton, LearnsTheSameInOtherUnits) {
  Rng rng(2);
  const MatrixXd A = randomSymmetric(4, rng), H = A * A + MatrixXd::Identity(4, 4);
  const VectorXd unit = (VectorXd(4) << 1e-3, 1., 1e4, 1e7).finished(), inverse = unit.cwiseInverse();
  QuasiNewton plain, in_units;
  plain.reset(4);
  in_units.reset(unit);
  for (int i = 0; i < 10; ++i) {
    const VectorXd s = random(4, rng), y = H * s;
    plain.update(s, y);
    in_units.update(unit.cwiseProduct(s), inverse.cwiseProduct(y));
    EXPECT_TRUE(near(unit.asDiagonal() * in_units.matrix() * unit.asDiagonal(), plain.matrix(), 1e-9));
  }
}

TEST(QuasiNewton, StaysPositiveDefiniteWhereTheCurvatureIsNegative) {
  Rng rng(1);
  const MatrixXd H = randomSymmetric(5, rng);
  ASSERT_LT(Eigen::SelfAdjointEigenSolver<MatrixXd>(H).eigenvalues().minCoeff(), -1.);
  QuasiNewton estimate;
  estimate.reset(5);
  for (int i = 0; i < 30; ++i) {
    const VectorXd s = random(5, rng);
    estimate.update(s, H * s);
    const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(estimate.matrix()).eigenvalues();
    EXPECT_GT(eigenvalues.minCoeff(), 0.) << "after " << i + 1;
  }
}

TEST(QuasiNewton, IgnoresStepsThatTellNothing) {
  QuasiNewton estimate;
  estimate.reset(2);
  estimate.update(VectorXd::Zero(2), VectorXd::Ones(2));
  estimate.update(VectorXd::Ones(2), VectorXd::Zero(2));
  estimate.update(VectorXd::Ones(2), VectorXd::Constant(2, std::nan("")));
  EXPECT_TRUE(estimate.matrix().isZero());
}
