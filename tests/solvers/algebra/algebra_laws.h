#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "tests/solvers/algebra/random_rows.h"
#include "tests/support/near.h"

namespace kinegraph {

/// Laws of the linear algebra of a SemismoothModel, compared with dense matrices made by their definitions, on
/// random problems of `variables`: half of the rows are costs, the others constraints.
template <class Algebra>
class AlgebraCase {
 public:
  using Vector = typename Algebra::Vector;
  static constexpr double kExact = 1e-10;

  AlgebraCase(int variables, bool shared, Rng& rng)
      : rng_(rng),
        nlp_(variables, std::vector<ObjectiveType>(std::size_t(2 * variables), ObjectiveType::sos), rng, shared),
        J_(nlp_.makeJacobian()),
        dense_(J_.toDense()) {
    for (int row = 0; row < 2 * variables; ++row) (row % 2 ? constraints_ : costs_).push_back(row);
    algebra_.emplace(nlp_, J_, constraints_, false);
    algebra_->setJacobian(J_);
    algebra_->setLinearCosts(costs_);
    algebra_->useLinearCosts();
  }

  void rowsAreThoseOfTheJacobian() {
    const VectorXd d = draw();
    for (int j = 0; j < m(); ++j) {
      EXPECT_NEAR(algebra_->rowTimes(j, padded(d)), row(j).dot(d), kExact);
      Vector sum = padded(d);
      algebra_->addRowTo(j, -2., sum);
      EXPECT_TRUE(near(sum.head(n()), d - 2. * row(j), kExact));
    }
  }

  void theLargestRiseIsThatOfTheBestCorner() {
    const VectorXd low = -draw().cwiseAbs(), high = draw().cwiseAbs();
    Vector to_low = algebra_->zeroVector(), to_high = to_low;
    algebra_->takeBox(low, high, to_low, to_high);
    for (int j = 0; j < m(); ++j) {
      const double rise = algebra_->largestRise(j, to_low, to_high);
      const VectorXd corner = (row(j).array() > 0.).select(high, low);
      EXPECT_NEAR(rise, row(j).dot(corner), kExact);
    }
  }

  void theHessianIsThatOfTheSquares() {
    const VectorXd d = draw(), phi = randomVector(int(dense_.rows()), rng_);
    Vector gradient = algebra_->zeroVector();
    algebra_->addLinearCostGradient(costs_, phi, gradient);
    VectorXd expected = VectorXd::Zero(n());
    for (int cost : costs_) expected += 2. * phi[cost] * dense_.row(cost).transpose();
    EXPECT_TRUE(near(gradient.head(n()), expected, kExact));
    EXPECT_TRUE(near(product(d), hessian() * d, kExact));
    for (int i = 0; i < n(); ++i) EXPECT_NEAR(algebra_->diagonal(i), hessian()(i, i), kExact);

    algebra_->copyLinearCosts();
    algebra_->addCost(constraints_[0], 3.);
    algebra_->addEntry(0, 0, .5);
    MatrixXd more = hessian() + 3. * row(0) * row(0).transpose();
    more(0, 0) += .5;
    EXPECT_TRUE(near(product(d), more * d, kExact));
    algebra_->useLinearCosts();
    EXPECT_TRUE(near(product(d), hessian() * d, kExact)) << "linear costs stay as they were";
  }

  /// K^-1 r of K = H + damping I + mu J_A^T J_A, with fixed variables and a block.
  void theFactorSolvesWhatItIsMadeOf(bool with_block) {
    const double damping = rng_.uniform(.1, 1.), mu = rng_.uniform(.1, 10.);
    MatrixXd K = hessian() + damping * MatrixXd::Identity(n(), n());
    MatrixXd room = MatrixXd::Zero(1, 1);
    if (with_block) {
      const int column = randomInt(0, n() - 1, rng_);
      algebra_->addBlock(column, room, [](auto&& M) { M(0, 0) += 2.; });
      K(column, column) += 2.;
    }
    std::vector<int> active;
    for (int j = 0; j < m(); ++j) {
      if (rng_.uniform() < .5) continue;
      active.push_back(j);
      K += mu * row(j) * row(j).transpose();
    }
    std::vector<char> fixed(std::size_t(algebra_->size()), false);
    for (int i = 0; i < n(); ++i) {
      if (rng_.uniform() < .8) continue;
      fixed[std::size_t(i)] = true;
      K.row(i).setZero();
      K.col(i).setZero();
      K(i, i) = 1.;
    }
    const VectorXd r = draw();
    Vector x = padded(r);
    ASSERT_TRUE(algebra_->factorize(damping, mu, active, fixed, 0));
    algebra_->solve(x);
    EXPECT_TRUE(near(K * x.head(n()), r, kExact * (1. + K.norm())));
    algebra_->dropBlocks();
    EXPECT_TRUE(near(product(r), hessian() * r, kExact)) << "blocks are gone";
  }

  void whatIsNotPositiveDefiniteIsRefused() {
    algebra_->setMultipleOfIdentity(1.);
    const std::vector<char> fixed(std::size_t(algebra_->size()), false);
    EXPECT_TRUE(algebra_->factorize(0., 1., {}, fixed, 0));
    algebra_->setMultipleOfIdentity(-1.);
    EXPECT_FALSE(algebra_->factorize(0., 1., {}, fixed, 0));
    EXPECT_TRUE(algebra_->factorize(2., 1., {}, fixed, 0));
    algebra_->useLinearCosts();
  }

 private:
  int n() const { return nlp_.dimension(); }
  int m() const { return int(constraints_.size()); }
  VectorXd draw() { return randomVector(n(), rng_); }
  VectorXd row(int j) const { return dense_.row(constraints_[std::size_t(j)]); }
  MatrixXd hessian() const {
    MatrixXd H = MatrixXd::Zero(n(), n());
    for (int cost : costs_) H += 2. * dense_.row(cost).transpose() * dense_.row(cost);
    return H;
  }
  Vector padded(const VectorXd& x) const {
    Vector out = algebra_->zeroVector();
    out.head(n()) = x;
    return out;
  }
  VectorXd product(const VectorXd& d) {
    Vector sum = algebra_->zeroVector();
    algebra_->addHessianProduct(padded(d), sum);
    return sum.head(n());
  }

  Rng& rng_;
  RandomRows nlp_;
  Jacobian J_;
  MatrixXd dense_;
  std::vector<int> costs_, constraints_;
  std::optional<Algebra> algebra_;
};

}  // namespace kinegraph
