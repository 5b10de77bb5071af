#include "kinegraph/math/lane_widths.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kinegraph/common/errors.h"

namespace kinegraph {
namespace {

TEST(LaneWidths, AscendFromTwoToAtMostTheMost) {
  const std::vector<int>& widths = laneWidths();
  ASSERT_FALSE(widths.empty());
  EXPECT_EQ(widths.front(), 2);
  EXPECT_LE(widths.back(), kMostLanes);
  EXPECT_TRUE(std::is_sorted(widths.begin(), widths.end()));
  for (const int width : widths) EXPECT_TRUE(width == 2 || width == 4 || width == 8);
}

TEST(LaneWidths, ZeroMeansTheWidestAndOthersStayOrAreErrors) {
  EXPECT_EQ(checkedLaneWidth(0), laneWidths().back());
  for (const int width : laneWidths()) EXPECT_EQ(checkedLaneWidth(width), width);
  EXPECT_THROW(checkedLaneWidth(3), ValueError);
  EXPECT_THROW(checkedLaneWidth(-2), ValueError);
}

}  // namespace
}  // namespace kinegraph
