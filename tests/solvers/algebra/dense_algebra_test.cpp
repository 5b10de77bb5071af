#include "kinegraph/solvers/algebra/dense_algebra.h"

#include "tests/solvers/algebra/algebra_laws.h"

using namespace kinegraph;

namespace {

constexpr int kMost = 8;

/// On problems of all sizes that it takes.
template <class Law>
void checkDense(int seed, const Law& law) {
  Rng rng{std::uint64_t(seed)};
  for (int sample = 0; sample < 40; ++sample) {
    AlgebraCase<DenseAlgebra<kMost>> problem(1 + sample % kMost, sample % 3 == 0, rng);
    law(problem, sample);
  }
}

}  // namespace

TEST(DenseAlgebra, RowsAreThoseOfTheJacobian) {
  checkDense(0, [](auto& problem, int) { problem.rowsAreThoseOfTheJacobian(); });
}

TEST(DenseAlgebra, TheLargestRiseIsThatOfTheBestCorner) {
  checkDense(1, [](auto& problem, int) { problem.theLargestRiseIsThatOfTheBestCorner(); });
}

TEST(DenseAlgebra, TheHessianIsThatOfTheSquares) {
  checkDense(2, [](auto& problem, int) { problem.theHessianIsThatOfTheSquares(); });
}

TEST(DenseAlgebra, TheFactorSolvesWhatItIsMadeOf) {
  checkDense(3, [](auto& problem, int sample) { problem.theFactorSolvesWhatItIsMadeOf(sample % 2 == 1); });
}

TEST(DenseAlgebra, WhatIsNotPositiveDefiniteIsRefused) {
  checkDense(4, [](auto& problem, int) { problem.whatIsNotPositiveDefiniteIsRefused(); });
}

TEST(DenseAlgebra, EntriesThatAreNoVariablesStayZero) {
  Rng rng(5);
  RandomRows nlp(3, std::vector<ObjectiveType>(6, ObjectiveType::sos), rng);
  const Jacobian J = nlp.makeJacobian();
  const std::vector<int> constraints = {1, 3, 5};
  DenseAlgebra<kMost> algebra(nlp, J, constraints, false);
  algebra.setJacobian(J);
  algebra.setLinearCosts({0, 2, 4});
  algebra.useLinearCosts();
  DenseAlgebra<kMost>::Vector x = algebra.zeroVector();
  x.head(3) = randomVector(3, rng);
  ASSERT_TRUE(algebra.factorize(.1, 2., {0, 1, 2}, std::vector<char>(kMost, false), 0));
  algebra.solve(x);
  EXPECT_TRUE(x.tail(kMost - 3).isZero(0.));
}
