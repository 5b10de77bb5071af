#include "kinegraph/solvers/algebra/band_algebra.h"

#include "tests/solvers/algebra/algebra_laws.h"

using namespace kinegraph;

namespace {

/// On small problems, and on paths with and without a variable that all slices share, which goes to the border.
template <class Law>
void checkBands(int seed, const Law& law) {
  Rng rng{std::uint64_t(seed)};
  for (int sample = 0; sample < 24; ++sample) {
    AlgebraCase<BandAlgebra> problem(sample % 2 ? 60 + sample : 1 + sample, sample % 4 == 1, rng);
    law(problem, sample);
  }
}

}  // namespace

TEST(BandAlgebra, RowsAreThoseOfTheJacobian) {
  checkBands(0, [](auto& problem, int) { problem.rowsAreThoseOfTheJacobian(); });
}

TEST(BandAlgebra, TheLargestRiseIsThatOfTheBestCorner) {
  checkBands(1, [](auto& problem, int) { problem.theLargestRiseIsThatOfTheBestCorner(); });
}

TEST(BandAlgebra, TheHessianIsThatOfTheSquares) {
  checkBands(2, [](auto& problem, int) { problem.theHessianIsThatOfTheSquares(); });
}

TEST(BandAlgebra, TheFactorSolvesWhatItIsMadeOf) {
  checkBands(3, [](auto& problem, int sample) { problem.theFactorSolvesWhatItIsMadeOf(sample % 3 == 1); });
}

TEST(BandAlgebra, WhatIsNotPositiveDefiniteIsRefused) {
  checkBands(4, [](auto& problem, int) { problem.whatIsNotPositiveDefiniteIsRefused(); });
}

TEST(BandAlgebra, AFactorThatIsKeptUpToTheFirstChangeIsThatOfANewOne) {
  Rng rng(5);
  for (int sample = 0; sample < 20; ++sample) {
    const int n = 40;
    RandomRows nlp(n, std::vector<ObjectiveType>(2 * n, ObjectiveType::sos), rng);
    const Jacobian J = nlp.makeJacobian();
    std::vector<int> constraints, costs, all;
    for (int row = 0; row < 2 * n; ++row) (row % 2 ? constraints : costs).push_back(row);
    for (int j = 0; j < n; ++j) all.push_back(j);
    const int left = randomInt(0, n - 1, rng);
    std::vector<int> fewer = all;
    fewer.erase(fewer.begin() + left);
    const std::vector<char> fixed(n, false);
    const VectorXd r = randomVector(n, rng);
    VectorXd x[2] = {r, r};
    for (const bool keeps : {false, true}) {
      BandAlgebra algebra(nlp, J, constraints, false);
      algebra.setJacobian(J);
      algebra.setLinearCosts(costs);
      algebra.useLinearCosts();
      if (keeps) ASSERT_TRUE(algebra.factorize(.1, 2., all, fixed, 0));
      ASSERT_TRUE(algebra.factorize(.1, 2., fewer, fixed, keeps ? algebra.firstColumn(left) : 0));
      algebra.solve(x[keeps]);
    }
    EXPECT_EQ(x[0], x[1]) << "to the bit";
  }
}
