#include "kinegraph/math/banded_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "kinegraph/common/random.h"

using namespace kinegraph;

namespace {

constexpr double kRounding = 1e-11;  // for matrices of condition below 1e4

/// A band of `width` below the diagonal of `size` columns, then `border` full rows.
struct Form {
  std::vector<int> last;
  int border = 0;
};

Form arrow(int size, int width, int border) {
  Form form{std::vector<int>(std::size_t(size - border)), border};
  for (int j = 0; j < size - border; ++j) form.last[std::size_t(j)] = std::min(j + width, size - border - 1);
  return form;
}

/// Columns that end anywhere.
Form ragged(int size, int border, Rng& rng) {
  Form form{std::vector<int>(std::size_t(size - border)), border};
  for (int j = 0; j < size - border; ++j)
    form.last[std::size_t(j)] = j + int(rng.uniform(0., double(size - border - j)) / 2.);
  return form;
}

BandedMatrix zero(const Form& form) { return BandedMatrix(form.last, form.border); }

/// Random entries where there may be some, and a dominant diagonal.
BandedMatrix randomPositive(const Form& form, Rng& rng) {
  BandedMatrix A = zero(form);
  for (int j = 0; j < A.size(); ++j) {
    for (int i = j + 1; i < A.size(); ++i) {
      if (A.keeps(i, j)) A.at(i, j) = rng.normal();
    }
    A.at(j, j) = 3. * A.size();
  }
  return A;
}

MatrixXd lowerTriangle(const BandedMatrix& A) {
  MatrixXd dense = MatrixXd::Zero(A.size(), A.size());
  for (int j = 0; j < A.size(); ++j) {
    for (int i = j; i < A.size(); ++i) {
      if (A.keeps(i, j)) dense(i, j) = A.at(i, j);
    }
  }
  return dense;
}

MatrixXd symmetric(const BandedMatrix& A) { return lowerTriangle(A).selfadjointView<Eigen::Lower>(); }

VectorXd randomVector(int size, Rng& rng) {
  VectorXd x(size);
  for (double& entry : x) entry = rng.normal();
  return x;
}

std::vector<Form> someForms() {
  Rng rng(4);
  return {arrow(1, 0, 0),   arrow(12, 0, 0),  arrow(30, 3, 0),    arrow(30, 3, 4),    arrow(25, 30, 0),
          arrow(40, 7, 40), arrow(27, 14, 7), ragged(35, 0, rng), ragged(60, 5, rng), ragged(61, 9, rng)};
}

}  // namespace

TEST(BandedMatrix, TheFactorOfBandedBorderedAndRaggedMatricesIsThatOfEigensCholesky) {
  Rng rng(1);
  for (const Form& form : someForms()) {
    BandedMatrix A = randomPositive(form, rng);
    const MatrixXd cholesky = symmetric(A).llt().matrixL(), expected = cholesky * cholesky.diagonal().asDiagonal();
    ASSERT_TRUE(A.factorize());
    EXPECT_LT((lowerTriangle(A) - expected).norm(), kRounding);
  }
}

TEST(BandedMatrix, SolvingInvertsTheProduct) {
  Rng rng(2);
  for (const Form& form : someForms()) {
    BandedMatrix A = randomPositive(form, rng);
    const VectorXd x = randomVector(A.size(), rng);
    VectorXd y = VectorXd::Zero(A.size());
    A.addProduct(x, y);
    ASSERT_TRUE(A.factorize());
    A.solveInPlace(y);
    EXPECT_LT((y - x).norm(), kRounding);
  }
}

TEST(BandedMatrix, AProductIsThatOfTheDenseMatrixAndIsAdded) {
  Rng rng(3);
  for (const Form& form : someForms()) {
    BandedMatrix A = randomPositive(form, rng);
    const VectorXd x = randomVector(A.size(), rng), before = randomVector(A.size(), rng);
    VectorXd y = before;
    A.addProduct(x, y);
    EXPECT_LT((y - before - symmetric(A) * x).norm(), kRounding);
  }
}

TEST(BandedMatrix, OuterAndCrossProductsOfAStackedVectorMakeItsWholeOuterProduct) {
  Rng rng(5);
  const int size = 12, v_column = 2, v_width = 3, u_column = 7, u_width = 4;
  const VectorXd u = randomVector(u_width, rng), v = randomVector(v_width, rng);
  const double weight = .7;
  VectorXd whole = VectorXd::Zero(size);
  whole.segment(u_column, u_width) = u;
  whole.segment(v_column, v_width) = v;
  for (const int border : {0, 2, 3, 9, size}) {
    BandedMatrix A = zero(arrow(size, size, border));
    A.addOuterProduct(u.data(), u_column, u_width, weight);
    A.addOuterProduct(v.data(), v_column, v_width, weight);
    A.addCrossProduct(u.data(), u_column, u_width, v.data(), v_column, v_width, weight);
    EXPECT_LT((symmetric(A) - weight * whole * whole.transpose()).norm(), kRounding) << border;
  }
}

TEST(BandedMatrix, AnIsolatedRowAndColumnAreThoseOfTheIdentity) {
  Rng rng(9);
  for (const Form& form : someForms()) {
    for (const int i :
         {0, int(form.last.size() + std::size_t(form.border)) / 2, int(form.last.size()) + form.border - 1}) {
      BandedMatrix A = randomPositive(form, rng);
      MatrixXd expected = symmetric(A);
      A.isolate(i);
      expected.row(i).setZero();
      expected.col(i).setZero();
      expected(i, i) = 1.;
      EXPECT_EQ((symmetric(A) - expected).norm(), 0.);
    }
  }
}

TEST(BandedMatrix, AddingToTheDiagonalAddsThatMultipleOfTheIdentity) {
  Rng rng(6);
  BandedMatrix A = randomPositive(arrow(20, 4, 2), rng);
  const MatrixXd before = symmetric(A);
  A.addToDiagonal(2.5);
  EXPECT_LT((symmetric(A) - before - 2.5 * MatrixXd::Identity(20, 20)).norm(), kRounding);
  A.setZero();
  EXPECT_EQ(symmetric(A).norm(), 0.);
}

TEST(BandedMatrix, ACopyKeepsTheMatrixThatItsFactorReplaces) {
  Rng rng(7);
  const Form form = arrow(20, 4, 2);
  const BandedMatrix A = randomPositive(form, rng);
  BandedMatrix factor = zero(form);
  factor.copyFrom(A);
  ASSERT_TRUE(factor.factorize());
  const MatrixXd LD = lowerTriangle(factor);
  EXPECT_LT((LD * LD.diagonal().cwiseInverse().asDiagonal() * LD.transpose() - symmetric(A)).norm(), kRounding);
}

TEST(BandedMatrix, AFactorizationThatBeginsLaterGivesTheSameFactor) {
  Rng rng(9);
  for (const Form& form : {arrow(12, 0, 0), arrow(30, 3, 0), arrow(25, 30, 0), arrow(60, 17, 0), ragged(61, 0, rng)}) {
    BandedMatrix before = randomPositive(form, rng), after = before;
    for (int column = 0; column < before.size(); column += 3) {
      const int first = BandedMatrix::startBefore(column);
      EXPECT_LE(first, column);
      for (int j = first; j < before.size(); ++j) after.at(j, j) = before.at(j, j) + 1.;
      BandedMatrix whole = zero(form), part = zero(form);
      whole.copyFrom(after);
      ASSERT_TRUE(whole.factorize());
      part.copyFrom(before);
      ASSERT_TRUE(part.factorize());
      part.copyFrom(after, first);
      ASSERT_TRUE(part.factorize(first));
      EXPECT_TRUE(lowerTriangle(part) == lowerTriangle(whole)) << "from column " << first << " of " << before.size();
      VectorXd x = randomVector(before.size(), rng), y = x;
      whole.solveInPlace(x);
      part.solveInPlace(y);
      EXPECT_TRUE(x == y);
      after.copyFrom(before);
    }
  }
}

TEST(BandedMatrix, MatricesThatAreNotPositiveDefiniteAreRefused) {
  Rng rng(8);
  for (const Form& form : someForms()) {
    BandedMatrix indefinite = randomPositive(form, rng), singular = indefinite;
    indefinite.at(indefinite.size() / 2, indefinite.size() / 2) = -1.;
    EXPECT_FALSE(indefinite.factorize());
    singular.setZero();
    EXPECT_FALSE(singular.factorize());
  }
}

TEST(BandedMatrix, MatricesWithNumbersThatAreNotFiniteAreRefused) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (const int column : {1, 3}) {
      BandedMatrix A = zero(arrow(6, 2, 0));
      A.addToDiagonal(1.);
      A.at(3, column) = bad;
      EXPECT_FALSE(A.factorize());
    }
  }
}

TEST(BandedMatrix, AMatrixWithoutRowsSolvesNothing) {
  BandedMatrix A;
  VectorXd x(0);
  EXPECT_EQ(A.size(), 0);
  EXPECT_TRUE(A.factorize());
  A.solveInPlace(x);
  EXPECT_EQ(x.size(), 0);
}
