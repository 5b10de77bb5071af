#include "kinegraph/tool_paths/plan_tool_path.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

TEST(CubicPieces, TheRangeOfAPieceIsThatOfDenseSamples) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    CubicPieces pieces;
    MatrixXd y(4, 2), slope(4, 2);
    for (double& number : y.reshaped()) number = normal(random);
    for (double& number : slope.reshaped()) number = 5. * normal(random);
    slope.row(3).setZero(), y(3, 1) = y(3, 0);    // a constant
    slope.row(2).setConstant(y(2, 1) - y(2, 0));  // a line
    pieces.addHermite({.5, 1.5}, y, slope, false);
    const CubicPieces::Range range = pieces.range(0);
    VectorXd least = VectorXd::Constant(4, 1e9), largest = -least;
    for (int k = 0; k <= 2000; ++k) {
      const VectorXd at = pieces.eval(0, .5 + k / 2000.);
      least = least.cwiseMin(at), largest = largest.cwiseMax(at);
    }
    for (int row = 0; row < 4; ++row) {
      EXPECT_LE(range.least[row], least[row] + 1e-12);
      EXPECT_GE(range.largest[row], largest[row] - 1e-12);
      EXPECT_NEAR(range.least[row], least[row], 1e-5);
      EXPECT_NEAR(range.largest[row], largest[row], 1e-5);
    }
  }
}

TEST(CubicPieces, APieceThatIsNotThereIsRefused) {
  const CubicPieces none;
  expectError<ValueError>([&] { none.eval(0.); }, {"no piece 0", "0 pieces"});
  expectError<ValueError>([&] { none.range(0); }, {"no piece 0"});
  CubicPieces one;
  one.addHermite({0., 1.}, MatrixXd::Zero(1, 2), MatrixXd::Zero(1, 2), false);
  expectError<ValueError>([&] { one.eval(1, .5); }, {"no piece 1"});
  expectError<ValueError>([&] { one.eval(-1, .5); }, {"no piece -1"});
}

}  // namespace
}  // namespace kinegraph
