#pragma GCC diagnostic ignored "-Wpsabi"  // packs wider than this file's registers: they stay within it

#include "kinegraph/math/lane_transpose.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace kinegraph::lanes {
namespace {

template <int Width>
void checkRows() {
  for (int size = 1; size <= 3 * Width + 1; ++size) {
    for (int count = 1; count <= Width; ++count) {
      const long stride = size + 3;
      std::vector<double> rows(std::size_t(stride) * Width), back(rows.size(), -1.);
      std::iota(rows.begin(), rows.end(), 1.);
      std::vector<Pack<Width>> packs(std::size_t(size) + Width);
      gatherRows(rows.data(), stride, count, size, packs.data());
      for (int k = 0; k < size; ++k) {
        for (int i = 0; i < Width; ++i) {
          ASSERT_EQ(packs[std::size_t(k)][i], rows[std::size_t((i < count ? i : count - 1) * stride + k)]);
        }
      }
      scatterRows(packs.data(), size, back.data(), stride, count);
      for (int i = 0; i < Width; ++i) {
        for (int k = 0; k < stride; ++k) {
          const auto at = std::size_t(i * stride + k);
          ASSERT_EQ(back[at], i < count && k < size ? rows[at] : -1.) << "written beyond its place";
        }
      }
    }
  }
}

TEST(LaneTranspose, RowsBecomeLanesAndComeBackAndNothingElseIsWritten) {
  checkRows<2>();
  checkRows<4>();
  checkRows<8>();
}

TEST(LaneTranspose, NumberJOfPackIBecomesNumberIOfPackJ) {
  Pack<8> packs[8];
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) packs[i][j] = 10. * i + j;
  }
  transpose(packs);
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) EXPECT_EQ(packs[i][j], 10. * j + i);
  }
}

}  // namespace
}  // namespace kinegraph::lanes
