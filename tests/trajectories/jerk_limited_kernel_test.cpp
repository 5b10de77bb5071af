#include "kinegraph/trajectories/jerk_limited_kernel.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "kinegraph/common/random.h"
#include "kinegraph/math/lane_widths.h"

namespace kinegraph {
namespace {

constexpr int kLanes = JerkLimitedKernel::kLanes, kIntervals = 3 * kLanes, kNumbers = kIntervals + kLanes + 1;
constexpr int kPlain = 3, kAtBegin = 2, kAtEnd = 2, kRows = kPlain + kAtBegin + kAtEnd;

/// Random rows of four blocks, the last one for a single interval, and the results of a kernel.
struct Work {
  std::vector<double> knots, middle, roots, knot_step, middle_step, sums;
  std::vector<JerkLimitedKernel::Rows> rows;
  std::vector<JerkLimitedKernel::Block> blocks;
  JerkLimitedKernel::Falls falls{};
  JerkLimitedKernel::Sums of{};

  Work() : sums(12 * kNumbers, 0.), rows(4 * kRows) {
    Rng rng(1);
    const auto draw = [&](std::vector<double>& to, double low, double high) {
      for (int k = 0; k < kNumbers; ++k) to.push_back(rng.uniform(low, high));
    };
    draw(knots, .5, 2.), draw(middle, .5, 2.), draw(knot_step, -.1, .1), draw(middle_step, -.1, .1);
    for (const double b : knots) roots.push_back(1. / std::sqrt(b));
    for (JerkLimitedKernel::Rows& row : rows) {
      for (int i = 0; i < kLanes; ++i) {
        for (auto& r : row.r) r[i] = rng.uniform(-1., 1.);
        row.offset[i] = rng.uniform(-.1, .1), row.size[i] = rng.uniform(.5, 3.);
      }
    }
    for (int n = 0; n < 4; ++n)
      blocks.push_back({n < 3 ? n * kLanes : kIntervals - 1, kPlain, kAtBegin, kAtEnd, rows.data() + n * kRows});
    for (int i = 0; i < 3; ++i) {
      of.slope[i] = sums.data() + i * kNumbers;
      of.slope_by_barrier[i] = sums.data() + (3 + i) * kNumbers;
    }
    for (int i = 0; i < 6; ++i) of.matrix[i] = sums.data() + (6 + i) * kNumbers;
  }

  void run(const JerkLimitedKernel& kernel) {
    const JerkLimitedKernel::Coefficients b{knots.data(), middle.data()}, step{knot_step.data(), middle_step.data()};
    kernel.begin(b, roots.data(), blocks.data(), 4, .01, 1e-3);
    kernel.findSteps(b, roots.data(), step, blocks.data(), 4, .01, falls);
    kernel.take(b, roots.data(), blocks.data(), 4, .5, .7, of);
  }
};

bool areEqual(const Work& a, const Work& b) {
  return std::memcmp(a.rows.data(), b.rows.data(), a.rows.size() * sizeof(JerkLimitedKernel::Rows)) == 0 &&
         std::memcmp(&a.falls, &b.falls, sizeof(a.falls)) == 0 && a.sums == b.sums &&
         std::memcmp(a.of.gap, b.of.gap, sizeof(a.of.gap)) == 0 &&
         std::memcmp(a.of.violation, b.of.violation, sizeof(a.of.violation)) == 0;
}

}  // namespace

TEST(JerkLimitedKernel, AllWidthsGiveTheSameBits) {
  Work narrow;
  narrow.run(jerkLimitedKernel(2));
  for (const int width : laneWidths()) {
    Work work;
    work.run(jerkLimitedKernel(width));
    EXPECT_TRUE(areEqual(narrow, work)) << width;
  }
}

TEST(JerkLimitedKernel, SlacksAreWhatIsLeftOfASizeAndMultipliersFitTheBarrier) {
  Work work;
  const JerkLimitedKernel::Coefficients b{work.knots.data(), work.middle.data()};
  jerkLimitedKernel().begin(b, work.roots.data(), work.blocks.data(), 4, .01, 1e-3);
  for (int r = 0; r < kRows; ++r) {
    const JerkLimitedKernel::Rows& row = work.rows[kRows + r];
    for (int i = 0; i < kLanes; ++i) {
      const int k = kLanes + i;
      const double value =
          row.r[0][i] * work.knots[k] + row.r[1][i] * work.middle[k] + row.r[2][i] * work.knots[k + 1] + row.offset[i];
      const double size = row.size[i] * (r < kPlain ? 1. : r < kPlain + kAtBegin ? work.roots[k] : work.roots[k + 1]);
      EXPECT_NEAR(row.slack[0][i], std::max(size - value, 1e-3), 1e-12);
      EXPECT_NEAR(row.slack[1][i], std::max(size + value, 1e-3), 1e-12);
      EXPECT_NEAR(row.slack[0][i] * row.dual[0][i], .01, 1e-15);
    }
  }
}

/// The sums are gradient and matrix of the Newton system: the terms of the gap decrease as its step predicts.
TEST(JerkLimitedKernel, AStepOfRowsWithoutRootsReachesTheBarrierToFirstOrder) {
  Work work;
  for (JerkLimitedKernel::Block& block : work.blocks) block.plain = kRows, block.at_begin = block.at_end = 0;
  for (double& by : work.knot_step) by *= 1e-4;
  for (double& by : work.middle_step) by *= 1e-4;
  const JerkLimitedKernel::Coefficients b{work.knots.data(), work.middle.data()},
      step{work.knot_step.data(), work.middle_step.data()};
  jerkLimitedKernel().begin(b, work.roots.data(), work.blocks.data(), 4, .01, 1e-3);
  jerkLimitedKernel().findSteps(b, work.roots.data(), step, work.blocks.data(), 4, .02, work.falls);
  for (const JerkLimitedKernel::Rows& row : work.rows) {
    for (int side = 0; side < 2; ++side) {
      for (int i = 0; i < kLanes; ++i) {
        const double slack = row.slack[side][i], dual = row.dual[side][i];
        EXPECT_NEAR(slack * dual + slack * row.dual_step[side][i] + dual * row.slack_step[side][i], .02, 1e-12);
      }
    }
  }
}

}  // namespace kinegraph
