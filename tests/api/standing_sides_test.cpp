#include "kinegraph/api/execution/standing_sides.h"

#include <gtest/gtest.h>

#include <numbers>

namespace kinegraph {
namespace {

/// Whether a box of 4 x 4 x 16 cm, tipped by 25 degrees against a wall of its place, leans inside this place.
bool leansInPlace(double side) {
  Config C;
  C.addText(R"(
    place: { X: [0 0 .5], shape: box, size: [1 1 .1], contact: 1 }
    wall (place): { Q: [.064 0 .15], shape: box, size: [.02 .1 .2], contact: 1 }
  )");
  C.getFrame("place").setShape(ShapeType::box, {side, side, .1});
  Frame box = C.addFrame("box", "place", "joint: rigid").setShape(ShapeType::box, {.04, .04, .16});
  const double tilt = 25. * std::numbers::pi / 180.;
  const double depth = .08 * std::cos(tilt) + .02 * std::sin(tilt);
  box.setPose({{0., 0., .55 + depth}, Quaterniond(Eigen::AngleAxisd(tilt, Vector3d::UnitY()))});
  return leansInside(C, "box", "place", Matrix3d::Identity());
}

TEST(StandingSides, WhatTipsAgainstAWallLeansOnlyInAPlaceThatIsNarrowerThanItIsLong) {
  EXPECT_TRUE(leansInPlace(.08));
  EXPECT_FALSE(leansInPlace(1.));
}

TEST(StandingSides, NothingLeansInAFrameWithoutATop) {
  Config C;
  C.addText(R"(
    world: {}
    wall (world): { Q: [.03 0 .1], shape: box, size: [.02 .1 .2], contact: 1 }
    box (world): { joint: rigid, Q: [0 0 .08], shape: box, size: [.04 .04 .16] }
  )");
  EXPECT_FALSE(leansInside(C, "box", "world", Matrix3d::Identity()));
}

}  // namespace
}  // namespace kinegraph
