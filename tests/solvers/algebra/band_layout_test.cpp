#include "kinegraph/solvers/algebra/band_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/solvers/algebra/random_rows.h"

using namespace kinegraph;

namespace {

constexpr int kLong = 120;  ///< variables of a path

RandomRows path(int variables, bool shared, Rng& rng) {
  return RandomRows(variables, std::vector<ObjectiveType>(std::size_t(2 * variables), ObjectiveType::sos), rng, shared);
}

}  // namespace

TEST(BandLayout, GivesEachVariableAPlaceOfItsOwn) {
  Rng rng(0);
  for (int sample = 0; sample < 30; ++sample) {
    const int variables = randomInt(1, kLong, rng);
    const BandLayout layout = bandLayout(variables, path(variables, sample % 2 == 1, rng).makeJacobian());
    std::vector<int> places = layout.place, all(std::size_t(variables), 0);
    std::iota(all.begin(), all.end(), 0);
    std::sort(places.begin(), places.end());
    EXPECT_EQ(places, all);
  }
}

TEST(BandLayout, PutsAVariableThatAllSlicesShareLast) {
  Rng rng(1);
  const BandLayout layout = bandLayout(kLong, path(kLong, true, rng).makeJacobian());
  EXPECT_EQ(layout.shared, 1);
  EXPECT_EQ(layout.place[0], kLong - 1);
  EXPECT_TRUE(std::is_sorted(layout.place.begin() + 1, layout.place.end())) << "the others stay in their order";
}

TEST(BandLayout, LeavesAPathAsItIs) {
  Rng rng(2);
  const BandLayout layout = bandLayout(kLong, path(kLong, false, rng).makeJacobian());
  EXPECT_EQ(layout.shared, 0);
  EXPECT_TRUE(std::is_sorted(layout.place.begin(), layout.place.end()));
}

TEST(BandLayout, ItsMatrixHasRoomForAllProductsOfARow) {
  Rng rng(3);
  for (int sample = 0; sample < 30; ++sample) {
    const int variables = randomInt(1, kLong, rng);
    const Jacobian J = path(variables, sample % 2 == 1, rng).makeJacobian();
    const BandLayout layout = bandLayout(variables, J);
    const BandedMatrix matrix = bandedMatrix(layout, J);
    EXPECT_EQ(matrix.size(), variables);
    EXPECT_EQ(matrix.border(), layout.shared);
    const MatrixXd dense = J.toDense(), product = dense.transpose() * dense;
    for (int i = 0; i < variables; ++i) {
      for (int j = 0; j < variables; ++j) {
        const int a = layout.place[std::size_t(i)], b = layout.place[std::size_t(j)];
        if (a >= b && product(i, j) != 0.) EXPECT_TRUE(matrix.keeps(a, b)) << "variables " << i << " and " << j;
      }
    }
  }
}

TEST(BandLayout, KeepsLittleOfALongPath) {
  Rng rng(4);
  for (const bool shared : {false, true}) {
    const Jacobian J = path(kLong, shared, rng).makeJacobian();
    const BandedMatrix matrix = bandedMatrix(bandLayout(kLong, J), J);
    int kept = 0;
    for (int j = 0; j < kLong; ++j) {
      for (int i = j; i < kLong; ++i) kept += matrix.keeps(i, j);
    }
    const int panel = 4;  // columns that are kept equally far down
    EXPECT_LE(kept, (4 + panel - 1 + int(shared)) * kLong) << "rows are at most four wide";
  }
}
