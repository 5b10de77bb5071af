#include "kinegraph/task_planning/held_shapes.h"

#include <gtest/gtest.h>

namespace kinegraph {
namespace {

const GraspWords kAcross{"x", std::string(kAllParts)};

TEST(HeldShapes, HandsThatCloseAcrossABottleHoldItsSidesAndNotItsNeck) {
  Config C;
  C.addText(R"(
    bottle: { X: [0 0 .1], shape: cylinder, size: [.2 .03], contact: 1 }
    neck (bottle): { Q: [0 0 .125], shape: cylinder, size: [.05 .013], contact: 1 }
  )");
  const HeldHeights sides = heldHeights(C, "bottle", kAcross);
  EXPECT_NEAR(sides.below, 0., 1e-9);
  EXPECT_NEAR(sides.height, .2, 1e-9);
  EXPECT_NEAR(heldHeights(C, "bottle", {"", std::string(kAllParts)}).height, .25, 1e-9);
}

TEST(HeldShapes, BallsAreHeldInTheirMiddle) {
  Config C;
  C.addText(R"(
    ball: { shape: sphere, size: [.03], contact: 1 }
    stub (ball): { Q: [0 0 .03], shape: sphere, size: [.01], contact: 1 }
  )");
  const Eigen::AlignedBox3d box = boxAcross(C.getFrame("ball"), 0);
  EXPECT_NEAR(box.sizes().x(), .06, 1e-9);
  for (const int beside : {1, 2}) {
    EXPECT_NEAR(box.center()[beside], 0., 1e-9);
    EXPECT_LT(box.sizes()[beside], .02);
  }
}

}  // namespace
}  // namespace kinegraph
