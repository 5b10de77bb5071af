#include "kinegraph/scene/hand_fingers.h"

#include <gtest/gtest.h>

#include "kinegraph/api/names.h"

namespace kinegraph {
namespace {

TEST(HandFingers, FingersThatSlideOpenByTheSumOfTheirMotions) {
  Config C;
  C.addFile(modelPath("panda/panda.g"));
  const std::vector<HandFingers> hands = handFingersOf(C);
  ASSERT_EQ(hands.size(), 1u);
  EXPECT_EQ(hands[0].joint, "panda_finger_joint1");
  EXPECT_EQ(hands[0].widthAt(.03), .06);
  EXPECT_EQ(hands[0].positionAt(.06), .03);
  EXPECT_EQ(hands[0].maxWidth(), .08);
}

TEST(HandFingers, FingersThatTurnHaveAnOpeningInMeters) {
  Config C;
  C.addFile(modelPath("scenarios/panda_fixRobotiq.g"));
  const std::vector<HandFingers> hands = handFingersOf(C);
  ASSERT_EQ(hands.size(), 1u);
  const HandFingers& hand = hands[0];
  EXPECT_EQ(hand.joint, "finger_joint");
  EXPECT_NEAR(hand.maxWidth(), .085, .012);  // of the 2F-85; its colliding shapes are a little thicker than its pads
  EXPECT_LT(hand.minWidth(), 2e-3);
  EXPECT_LT(hand.slopeAt(.2), 0.);  // a larger position closes it
  double before = hand.widthAt(0.);
  for (double q = .1; q < .5; q += .1) {
    EXPECT_LT(hand.widthAt(q), before);
    before = hand.widthAt(q);
    EXPECT_NEAR(hand.positionAt(before), q, 1e-9);
  }
  EXPECT_EQ(hand.positionAt(0.), .8);
  EXPECT_EQ(hand.positionAt(1.), 0.);
}

TEST(HandFingers, CarriagesSideBySideOnARailAreNoPads) {
  Config C;
  C.addFile(modelPath("trossen/trossen.g"));
  C.selectJoints({"joint_0", "joint_1", "joint_2", "joint_3", "joint_4", "joint_5"});
  const std::vector<HandFingers> hands = handFingersOf(C);
  ASSERT_EQ(hands.size(), 1u);
  const HandFingers& hand = hands[0];
  EXPECT_EQ(hand.pads, (std::vector<std::string>{"gripper_right_0", "gripper_left_0"}));
  EXPECT_NEAR(hand.maxWidth(), .078, 1e-3);
  EXPECT_EQ(hand.widthAt(.004), 0.);  // the fingers overlap
  EXPECT_NEAR(hand.widthAt(.02), .03, 1e-3);
  EXPECT_NEAR(hand.positionAt(.03), .02, 1e-3);
}

}  // namespace
}  // namespace kinegraph
