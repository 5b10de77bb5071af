#include "kinegraph/math/skyline.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "kinegraph/base/random.h"

using namespace kinegraph;

namespace {

constexpr double kRounding = 1e-11;  // for matrices of condition below 1e4

/// A profile of `size` rows: a band of `width`, then `border` full rows.
std::vector<int> arrowProfile(int size, int width, int border) {
  std::vector<int> first(size);
  for (int i = 0; i < size; ++i) first[i] = i < size - border ? std::max(0, i - width) : 0;
  return first;
}

/// A profile whose rows begin anywhere.
std::vector<int> raggedProfile(int size, Rng& rng) {
  std::vector<int> first(size);
  for (int i = 0; i < size; ++i) first[i] = int(rng.uniform(0., i + 1.));
  return first;
}

/// Random entries within the profile and a dominant diagonal.
SkylineMatrix randomPositive(const std::vector<int>& first, Rng& rng) {
  SkylineMatrix A(first);
  for (int i = 0; i < A.size(); ++i) {
    for (int j = A.first(i); j < i; ++j) A.at(i, j) = rng.normal();
    A.at(i, i) = 3. * A.size();
  }
  return A;
}

MatrixXd lowerTriangle(const SkylineMatrix& A) {
  MatrixXd dense = MatrixXd::Zero(A.size(), A.size());
  for (int i = 0; i < A.size(); ++i) {
    for (int j = A.first(i); j <= i; ++j) dense(i, j) = A.at(i, j);
  }
  return dense;
}

MatrixXd symmetric(const SkylineMatrix& A) { return lowerTriangle(A).selfadjointView<Eigen::Lower>(); }

VectorXd randomVector(int size, Rng& rng) {
  VectorXd x(size);
  for (double& entry : x) entry = rng.normal();
  return x;
}

std::vector<std::vector<int>> someProfiles() {
  Rng rng(4);
  return {arrowProfile(1, 0, 0),   arrowProfile(12, 0, 0),  arrowProfile(30, 3, 0), arrowProfile(30, 3, 4),
          arrowProfile(25, 30, 0), arrowProfile(40, 7, 40), raggedProfile(35, rng), raggedProfile(60, rng)};
}

}  // namespace

TEST(Skyline, TheFactorOfBandedBorderedAndRaggedMatricesIsEigensCholeskyFactor) {
  Rng rng(1);
  for (const std::vector<int>& profile : someProfiles()) {
    SkylineMatrix A = randomPositive(profile, rng);
    const MatrixXd expected = symmetric(A).llt().matrixL();
    ASSERT_TRUE(A.factorize());
    EXPECT_LT((lowerTriangle(A) - expected).norm(), kRounding);
  }
}

TEST(Skyline, SolvingInvertsTheProduct) {
  Rng rng(2);
  for (const std::vector<int>& profile : someProfiles()) {
    SkylineMatrix A = randomPositive(profile, rng);
    const VectorXd x = randomVector(A.size(), rng);
    VectorXd y = VectorXd::Zero(A.size());
    A.addProduct(x, y);
    ASSERT_TRUE(A.factorize());
    A.solveInPlace(y);
    EXPECT_LT((y - x).norm(), kRounding);
  }
}

TEST(Skyline, AProductIsThatOfTheDenseMatrixAndIsAdded) {
  Rng rng(3);
  for (const std::vector<int>& profile : someProfiles()) {
    const SkylineMatrix A = randomPositive(profile, rng);
    const VectorXd x = randomVector(A.size(), rng), before = randomVector(A.size(), rng);
    VectorXd y = before;
    A.addProduct(x, y);
    EXPECT_LT((y - before - symmetric(A) * x).norm(), kRounding);
  }
}

TEST(Skyline, OuterAndCrossProductsOfAStackedVectorMakeItsWholeOuterProduct) {
  Rng rng(5);
  const int size = 12, v_column = 2, v_width = 3, u_column = 7, u_width = 4;
  SkylineMatrix A(arrowProfile(size, size, 0));
  const VectorXd u = randomVector(u_width, rng), v = randomVector(v_width, rng);
  const double weight = .7;
  A.addOuterProduct(u.data(), u_column, u_width, weight);
  A.addOuterProduct(v.data(), v_column, v_width, weight);
  A.addCrossProduct(u.data(), u_column, u_width, v.data(), v_column, v_width, weight);
  VectorXd whole = VectorXd::Zero(size);
  whole.segment(u_column, u_width) = u;
  whole.segment(v_column, v_width) = v;
  EXPECT_LT((symmetric(A) - weight * whole * whole.transpose()).norm(), kRounding);
}

TEST(Skyline, AddingToTheDiagonalAddsThatMultipleOfTheIdentity) {
  Rng rng(6);
  SkylineMatrix A = randomPositive(arrowProfile(20, 4, 2), rng);
  const MatrixXd before = symmetric(A);
  A.addToDiagonal(2.5);
  EXPECT_LT((symmetric(A) - before - 2.5 * MatrixXd::Identity(20, 20)).norm(), kRounding);
  A.setZero();
  EXPECT_EQ(symmetric(A).norm(), 0.);
}

TEST(Skyline, ACopyKeepsTheMatrixThatItsFactorReplaces) {
  Rng rng(7);
  const std::vector<int> profile = arrowProfile(20, 4, 2);
  const SkylineMatrix A = randomPositive(profile, rng);
  SkylineMatrix factor(profile);
  factor.copyFrom(A);
  ASSERT_TRUE(factor.factorize());
  const MatrixXd L = lowerTriangle(factor);
  EXPECT_LT((L * L.transpose() - symmetric(A)).norm(), kRounding);
}

TEST(Skyline, MatricesThatAreNotPositiveDefiniteAreRefused) {
  Rng rng(8);
  for (const std::vector<int>& profile : someProfiles()) {
    SkylineMatrix indefinite = randomPositive(profile, rng), singular = indefinite;
    indefinite.at(indefinite.size() / 2, indefinite.size() / 2) = -1.;
    EXPECT_FALSE(indefinite.factorize());
    singular.setZero();
    EXPECT_FALSE(singular.factorize());
  }
}

TEST(Skyline, MatricesWithNumbersThatAreNotFiniteAreRefused) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (const int column : {1, 3}) {
      SkylineMatrix A(arrowProfile(6, 2, 0));
      A.addToDiagonal(1.);
      A.at(3, column) = bad;
      EXPECT_FALSE(A.factorize());
    }
  }
}

TEST(Skyline, AMatrixWithoutRowsSolvesNothing) {
  SkylineMatrix A;
  VectorXd x(0);
  EXPECT_EQ(A.size(), 0);
  EXPECT_TRUE(A.factorize());
  A.solveInPlace(x);
  EXPECT_EQ(x.size(), 0);
}
