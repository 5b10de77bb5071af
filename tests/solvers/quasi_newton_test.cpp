#include "kinegraph/solvers/quasi_newton.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "kinegraph/base/random.h"
#include "tests/support/near.h"

using namespace kinegraph;

namespace {

VectorXd random(int n, Rng& rng) {
  VectorXd x(n);
  for (double& value : x) value = rng.normal();
  return x;
}

}  // namespace

TEST(QuasiNewton, RepeatsTheLastChangeOfTheGradient) {
  Rng rng(0);
  const MatrixXd A = MatrixXd::Random(4, 4), H = A * A.transpose() + MatrixXd::Identity(4, 4);
  QuasiNewton estimate;
  estimate.reset(4);
  for (int i = 0; i < 20; ++i) {
    const VectorXd s = random(4, rng), y = H * s;
    estimate.update(s, y);
    if (s.dot(y) > .2 * s.dot(estimate.matrix() * s)) EXPECT_TRUE(near(estimate.matrix() * s, y, 1e-9));
  }
  EXPECT_LT((estimate.matrix() - H).norm(), .1 * H.norm()) << "a quadratic is learnt";
}

TEST(QuasiNewton, StaysPositiveDefiniteWhereTheCurvatureIsNegative) {
  Rng rng(1);
  QuasiNewton estimate;
  estimate.reset(5);
  for (int i = 0; i < 100; ++i) estimate.update(random(5, rng), random(5, rng));
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(estimate.matrix()).eigenvalues().minCoeff(), 0.);
}

TEST(QuasiNewton, IgnoresStepsThatTellNothing) {
  QuasiNewton estimate;
  estimate.reset(2);
  estimate.update(VectorXd::Zero(2), VectorXd::Ones(2));
  estimate.update(VectorXd::Ones(2), VectorXd::Zero(2));
  estimate.update(VectorXd::Ones(2), VectorXd::Constant(2, std::nan("")));
  EXPECT_TRUE(estimate.matrix().isZero());
}
