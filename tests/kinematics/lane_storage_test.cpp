#include "kinegraph/kinematics/lane_storage.h"

#include <gtest/gtest.h>

namespace kinegraph {
namespace {

TEST(LaneStorage, PartsFollowOneAnotherAlignedAndZero) {
  for (const int lanes : {2, 4, 8}) {
    std::vector<double> storage(1000, 7.);
    double *first = nullptr, *second = nullptr;
    layOutLanes(storage, lanes, {{&first, 3}, {&second, 5}});
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(first) % (std::size_t(lanes) * sizeof(double)), 0u);
    EXPECT_EQ(second - first, 3 * lanes);
    EXPECT_GE(first, storage.data());
    EXPECT_LE(second + 5 * lanes, storage.data() + storage.size());
    EXPECT_TRUE(std::all_of(storage.begin(), storage.end(), [](double x) { return x == 0.; }));
  }
}

TEST(LaneStorage, TheWorldIsTheIdentityInEachLane) {
  const int lanes = 4;
  std::vector<double> pose(12 * lanes, 0.);
  setWorld(pose.data(), lanes);
  for (int k = 0; k < 12; ++k) {
    const double expected = k == 0 || k == 4 || k == 8 ? 1. : 0.;
    for (int lane = 0; lane < lanes; ++lane) EXPECT_EQ(pose[std::size_t(k * lanes + lane)], expected);
  }
}

}  // namespace
}  // namespace kinegraph
