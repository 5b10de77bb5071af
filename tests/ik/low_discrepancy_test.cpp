#include "kinegraph/ik/low_discrepancy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace kinegraph {
namespace {

TEST(LowDiscrepancy, EveryCoordinateFillsTheIntervalWithoutLargeGaps) {
  constexpr int kPoints = 200, kDimensions = 7;
  const LowDiscrepancy sequence(kDimensions, 3);
  for (int k = 0; k < kDimensions; ++k) {
    std::vector<double> values;
    for (int i = 0; i < kPoints; ++i) values.push_back(sequence.at(i, k));
    std::sort(values.begin(), values.end());
    EXPECT_GE(values.front(), 0.);
    EXPECT_LT(values.back(), 1.);
    for (int i = 1; i < kPoints; ++i) EXPECT_LT(values[i] - values[i - 1], 8. / kPoints) << "coordinate " << k;
  }
}

TEST(LowDiscrepancy, TheGoldenRatioGivesTheStepInOneDimension) {
  const LowDiscrepancy sequence(1, 0);
  double step = sequence.at(1, 0) - sequence.at(0, 0);
  if (step < 0.) step += 1.;
  EXPECT_NEAR(step, .6180339887498949, 1e-12);
}

TEST(LowDiscrepancy, TheSeedShiftsTheSequence) {
  EXPECT_NE(LowDiscrepancy(2, 0).at(0, 0), LowDiscrepancy(2, 1).at(0, 0));
  EXPECT_EQ(LowDiscrepancy(2, 5).at(9, 1), LowDiscrepancy(2, 5).at(9, 1));
}

}  // namespace
}  // namespace kinegraph
