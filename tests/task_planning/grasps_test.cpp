#include "kinegraph/task_planning/grasps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/scene/frame_setters.h"
#include "kinegraph/task_planning/task_tools.h"
#include "tests/task_planning/task_scenes.h"

namespace kinegraph {
namespace {

/// A hand whose fingers reach 1 cm beyond its frame, above a table.
Config handWithFingers() {
  Config C = handAboveATable();
  C.getFrame("hand").editAttributes().set({"opening", {}, {}, {.08, {}}, {}});
  for (const auto& [name, y] : {std::pair("left", ".04"), std::pair("right", "-.04")}) {
    const std::string slide = std::string(name) + "_slide";
    C.addFrame(slide, "hand", std::string("joint: transX, joint_active: False, limits: [-.04 .04], q: ") + y);
    C.addFrame(name, slide, "shape: box, size: [.016 .02 .02], contact: -1");
  }
  return C;
}

Frame lying(Config& C, const std::string& name, const Vector3d& size) {
  Frame frame = C.addFrame(name, "table", "joint: rigid");
  frame.setRelativePosition({.3, .2, .05 + .5 * size.z()});
  return frame.setShape(ShapeType::box, {size.x(), size.y(), size.z()}).setContact(1);
}

double shiftOf(Config C, const std::string& obj, const std::string& variant) {
  const std::string name = addGripFrame(C, "hand", obj, variant);
  return name == "hand" ? 0. : -C.getFrame(name).getRelativePosition().z();
}

TEST(Grasps, FingersReachToTheirTips) {
  const Config C = handWithFingers();
  EXPECT_NEAR(fingerReach(C, "hand"), .01, 1e-12);
  EXPECT_EQ(fingerReach(handAboveATable(), "hand"), 0.) << "without fingers";
}

TEST(Grasps, FingersThatFollowAnotherJointReachToTheirTips) {
  Config C = handAboveATable();
  C.addFrame("slide", "hand", "joint: transX, joint_active: False, limits: [0 .04], q: .04");
  C.addFrame("other_slide", "hand", "joint: transX, mimic: slide, scale: -1");
  for (const char* name : {"slide", "other_slide"})
    C.addFrame(std::string("finger of ") + name, name, "shape: box, size: [.016 .02 .02], contact: -1");
  EXPECT_EQ(fingerShapes(C, "hand").size(), 2U);
  EXPECT_NEAR(fingerReach(C, "hand"), .01, 1e-12);
}

TEST(Grasps, FingersAboveAndBelowAnObjectAreTriedLast) {
  Config C = handWithFingers();
  lying(C, "card", {.06, .07, .008});
  EXPECT_EQ(graspVariants(C, "card", "hand"), std::vector<std::string>({"x", "y", "z"}));
}

TEST(Grasps, TheTipsOfFingersHoldWhatIsLow) {
  Config C = handWithFingers();
  lying(C, "card", {.06, .09, .008});
  lying(C, "cube", {.05, .05, .05});
  lying(C, "standing", {.008, .06, .09});
  lying(C, "foil", {.06, .09, .002});
  EXPECT_NEAR(shiftOf(C, "card", "x"), .01 + .002 - .004, 1e-12) << "tips end 2 mm above the table";
  EXPECT_EQ(shiftOf(C, "card", "z"), 0.) << "from the side";
  EXPECT_EQ(shiftOf(C, "cube", "x"), 0.);
  EXPECT_EQ(shiftOf(C, "standing", "x"), 0.);
  EXPECT_EQ(shiftOf(C, "foil", "x"), 0.);
}

TEST(Grasps, ABodyIsHeldByPartsThatFingersGetAround) {
  Config C = handWithFingers();
  lying(C, "lid", {.14, .14, .008});
  C.addFrame("knob", "lid", "shape: cylinder, size: [.025 .014], contact: 1").setRelativePosition({0., 0., .0165});
  EXPECT_EQ(graspVariants(C, "lid", "hand")[0], "around of knob");
  const auto guess = graspGuess(C, "lid", "hand", "around of knob");
  ASSERT_TRUE(guess);
  EXPECT_GT(guess->back.z(), .99) << "from above";
  EXPECT_FALSE(graspGuess(C, "lid", "hand", "z")) << "a finger would be in the table";

  lying(C, "mug", {.1, .1, .006});
  C.addFrame("wall", "mug", "shape: box, size: [.005 .1 .09], contact: 1").setRelativePosition({.0475, 0., .045});
  C.addFrame("other", "mug", "shape: box, size: [.005 .1 .09], contact: 1").setRelativePosition({-.0475, 0., .045});
  const std::vector<std::string> ways = graspVariants(C, "mug", "hand");
  ASSERT_GE(ways.size(), 2u);
  EXPECT_TRUE(ways[0] == "x of wall" || ways[0] == "x of other") << ways[0];
  EXPECT_TRUE(ways[1] == "x of wall" || ways[1] == "x of other") << ways[1];
}

TEST(Grasps, OneShapeIsHeldAlongItsNarrowAxes) {
  Config C = handWithFingers();
  lying(C, "box", {.06, .1, .04});
  EXPECT_EQ(graspVariants(C, "box", "hand"), (std::vector<std::string>{"x", "z"})) << "no finger gets below it";
  EXPECT_FALSE(graspGuess(C, "box", "hand", "x")) << "one shape needs no search for a part";
}

TEST(Grasps, AFlawNamesWhatNoFingerGetsAround) {
  Config C = handWithFingers();
  lying(C, "book", {.12, .17, .02});
  lying(C, "foil", {.06, .09, .002});
  lying(C, "cube", {.05, .05, .05});
  EXPECT_NE(graspFlaw(C, "book", "table", "hand").find("'book' is wider than 'hand' opens (0.080 m)"),
            std::string::npos);
  EXPECT_NE(graspFlaw(C, "foil", "table", "hand").find("'foil' is 2.0 mm high"), std::string::npos);
  EXPECT_EQ(graspFlaw(C, "cube", "table", "hand"), "");
}

/// A hand whose fingers open from 5 to 13 cm.
Config handThatDoesNotClose() {
  Config C = handAboveATable();
  C.addFrame("mover", "hand", "joint: transY, joint_active: False, limits: [0 .04]");
  C.addFrame("left", "mover", "shape: box, size: [.02 .02 .02], contact: -1").setRelativePosition({0., .035, 0.});
  C.addFrame("other", "hand", "joint: transY, joint_active: False, mimic: mover, joint_scale: -1");
  C.addFrame("right", "other", "shape: box, size: [.02 .02 .02], contact: -1").setRelativePosition({0., -.035, 0.});
  lying(C, "pen", {.03, .04, .14});
  lying(C, "can", {.06, .07, .14});
  return C;
}

TEST(Grasps, FingersThatDoNotCloseHoldNoNarrowerObject) {
  const Config C = withOpenings(handThatDoesNotClose(), {"hand"});
  EXPECT_TRUE(graspVariants(C, "pen", "hand").empty());
  EXPECT_EQ(graspMisfit(C, "pen", "hand"), "'pen' does not fit between the fingers of 'hand' (0.050 to 0.130 m)");
  EXPECT_EQ(graspVariants(C, "can", "hand"), (std::vector<std::string>{"x", "y"}));
}

TEST(Grasps, EachOpeningOfAFrameOverridesThatOfTheFingers) {
  const auto set = [](const std::string& key, double width) {
    Config C = handThatDoesNotClose();
    C.getFrame("hand").editAttributes().set({key, {}, {}, {width, {}}, {}});
    return withOpenings(C, {"hand"});
  };
  EXPECT_EQ(graspVariants(set("least_opening", 0.), "pen", "hand").size(), 2U);
  EXPECT_EQ(graspVariants(set("least_opening", .035), "pen", "hand"), std::vector<std::string>{"y"});
  EXPECT_EQ(graspMisfit(set("opening", .1), "pen", "hand"),
            "'pen' does not fit between the fingers of 'hand' (0.050 to 0.100 m)");
}

TEST(Grasps, AnOpeningThatIsNoNumberIsRefused) {
  for (const char* key : {"opening", "least_opening"}) {
    Config C = handThatDoesNotClose();
    Frame hand = C.getFrame("hand");
    setAttributes(hand, std::string(key) + ": wide");
    try {
      graspVariants(withOpenings(C, {"hand"}), "pen", "hand");
      FAIL() << key;
    } catch (const ValueError& error) {
      EXPECT_NE(std::string(error.what()).find(std::string("frame 'hand' has the attribute ") + key), std::string::npos)
          << error.what();
    }
  }
}

TEST(Grasps, WhatLiesRestsAsItLies) {
  Config C = handWithFingers();
  Frame pen = lying(C, "pen", {.1, .1, .1});
  pen.setShape(ShapeType::cylinder, {.14, .01});
  EXPECT_TRUE(restingRotation(pen).isIdentity(0.)) << "upright";
  EXPECT_NEAR(depthBelow(pen, Matrix3d::Identity()), .07, 1e-12);
  const Quaterniond lies(Eigen::AngleAxisd(.7, Vector3d::UnitZ()) * Eigen::AngleAxisd(.5 * M_PI, Vector3d::UnitY()) *
                         Eigen::AngleAxisd(.3, Vector3d::UnitZ()));
  pen.setRelativeQuaternion(lies);
  const Matrix3d R = restingRotation(pen);
  EXPECT_LT((R.col(2) - Vector3d::UnitX()).norm(), 1e-9) << "its axis is along x";
  EXPECT_LT((R.transpose().col(2) - lies.toRotationMatrix().transpose().col(2)).norm(), 1e-9) << "the same side is up";
  EXPECT_NEAR(depthBelow(pen, R), .01, 1e-9);
}

}  // namespace
}  // namespace kinegraph
