#include "kinegraph/komo/path/time_grid.h"

#include <gtest/gtest.h>

#include <limits>

#include "kinegraph/common/errors.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

using Slices = std::pair<int, int>;

TEST(TimeGrid, HasASliceForEachPartOfAPhaseThatIsBegun) {
  EXPECT_EQ(TimeGrid(2., 10, 1., 0).slices(), 20);
  EXPECT_EQ(TimeGrid(2.5, 4, 1., 2).slices(), 10);
  EXPECT_EQ(TimeGrid(1.01, 4, 1., 2).slices(), 5);
  EXPECT_EQ(TimeGrid(.1 * 3., 10, 1., 0).slices(), 3);  // 3.0000000000000004 is not rounded up
  EXPECT_TRUE(TimeGrid().empty());
}

TEST(TimeGrid, SlicesAndTheirTimesAreInverse) {
  const TimeGrid grid(3., 7, 5., 2);
  for (int slice = -2; slice < 25; ++slice) EXPECT_EQ(grid.sliceAt(grid.timeOf(slice)), slice);
  EXPECT_EQ(grid.timeOf(6), 1.);
  EXPECT_EQ(grid.tau(), 5. / 7.);
  EXPECT_EQ(grid.durationPerPhase(), grid.tau() * 7);
}

TEST(TimeGrid, TimesSelectTheSlicesOfTheSpecification) {
  const TimeGrid grid(2., 10, 1., 0);
  EXPECT_EQ(grid.select({}), Slices(0, 19));
  EXPECT_EQ(grid.select({1.}), Slices(9, 9));
  EXPECT_EQ(grid.select({.05}), Slices(0, 0));
  EXPECT_EQ(grid.select({1.04}), Slices(9, 9));
  EXPECT_EQ(grid.select({1.05}), Slices(10, 10));
  EXPECT_EQ(grid.select({0., 1.}), Slices(0, 9));
  EXPECT_EQ(grid.select({1., 2.}), Slices(9, 19));
  EXPECT_EQ(grid.select({.95, 1.05}), Slices(9, 10));
  EXPECT_EQ(grid.select({.5, 3.}), Slices(4, 19));
  EXPECT_EQ(grid.select({1., -1.}), Slices(9, 19));
  for (std::vector<double> times : {std::vector<double>{0.}, {3.}, {2., 1.}}) {
    const auto [from, to] = grid.select(times);
    EXPECT_GT(from, to);
  }
  expectError<ValueError>([&] { grid.select({1., 2., 3.}); }, {"3 entries", "[from, to]"});
  expectError<ValueError>([&] { grid.select({std::numeric_limits<double>::infinity()}); }, {"inf", "phase times"});
}

TEST(TimeGrid, RefusesNumbersThatMakeNoGrid) {
  expectError<ValueError>([] { TimeGrid(0., 1, 1., 0); }, {"phases is 0"});
  expectError<ValueError>([] { TimeGrid(1., 0, 1., 0); }, {"slicesPerPhase is 0"});
  expectError<ValueError>([] { TimeGrid(1., 1, -1., 0); }, {"durationPerPhase is -1"});
  expectError<ValueError>([] { TimeGrid(1., 1, 1., 11); }, {"kOrder is 11"});
}
