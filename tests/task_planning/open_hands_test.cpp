#include "kinegraph/task_planning/open_hands.h"

#include <gtest/gtest.h>

namespace kinegraph {
namespace {

/// A hand whose first finger overlaps a block beside it while it is nearly closed, and another one when it is open.
Config handBetweenBlocks() {
  Config C;
  C.addText(R"(
    world: {}
    lift (world): { joint: transZ, limits: [-1 1] }
    f1 (lift): { joint: transX, joint_active: false, q: .01, limits: [0 .05] }
    f1_shape (f1): { Q: [.01 0 0], shape: ssBox, size: [.02 .02 .06 .003], contact: 1 }
    f2 (lift): { joint: transX, mimic: f1, joint_scale: -1 }
    f2_shape (f2): { Q: [-.01 0 0], shape: ssBox, size: [.02 .02 .06 .003], contact: 1 }
    gripper (lift): { shape: marker, size: [.03] }
    inner (world): { Q: [.008 0 0], shape: ssBox, size: [.012 .02 .02 .002], contact: 1 }
    outer (world): { Q: [.075 0 0], shape: ssBox, size: [.02 .02 .02 .002], contact: 1 }
  )");
  return C;
}

TEST(OpenHands, AnOverlapThatEndsDoesNotHideOneThatBegins) {
  const Config C = handBetweenBlocks();
  ASSERT_EQ(C.getCollisions(-1e-3).size(), 1u);
  EXPECT_TRUE(opensFreely(C, "gripper", .06));
  EXPECT_FALSE(opensFreely(C, "gripper", .1));
}

TEST(OpenHands, NarrowerOpeningsHaveRoomForTheObjectsThatAreNamed) {
  Config C = handBetweenBlocks();
  for (const auto& [name, width] : {std::pair("pen", .01), std::pair("cup", .06)})
    C.addFrame(name, "world")
        .setPosition({.5, 0., 0.})
        .setShape(ShapeType::ssBox, {width, .1, .1, .002})
        .setContact(1)
        .setJoint(JointType::rigid);
  const std::vector<double> for_pen = narrowerOpenings(C, {"pen"}), for_both = narrowerOpenings(C, {"pen", "cup"});
  ASSERT_FALSE(for_pen.empty());
  ASSERT_FALSE(for_both.empty());
  EXPECT_LT(for_pen[0], .03);
  EXPECT_GT(for_both[0], .06);
  EXPECT_TRUE(narrowerOpenings(C, {}).empty());
}

}  // namespace
}  // namespace kinegraph
