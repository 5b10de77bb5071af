#include "kinegraph/task_planning/place_frames.h"

#include <gtest/gtest.h>

#include "kinegraph/task_planning/task_actions.h"

using namespace kinegraph;

namespace {

Config shelfWithThings() {
  Config C;
  C.addText(R"g(
world: {}
table (world): { Q: [0 0 .5], shape: ssBox, size: [1 1 .1 .01], contact: 1 }
pad (world): { Q: [.2 0 .56], shape: ssBox, size: [.1 .1 .02 .002], contact: 1 }
plate (world): { Q: [-.2 0 .555], shape: cylinder, size: [.01 .1], contact: 1 }
slope (world): { Q: "t(0 .3 .6) d(10 1 0 0)", shape: ssBox, size: [.2 .2 .02 .002], contact: 1
}
sliver (world): { Q: [0 -.3 .56], shape: ssBox, size: [.04 .2 .02 .002], contact: 1 }
crate (world): { Q: [.3 .3 .55] }
floor (crate): { Q: [0 0 .01], shape: ssBox, size: [.2 .2 .02 .002], contact: 1 }
on_pad (world): { Q: [.2 0 .6], joint: rigid, shape: ssBox, size: [.05 .05 .06 .004], contact: 1 }
on_plate (table): { Q: [-.28 0 .085], joint: rigid, shape: ssBox, size: [.05 .05 .05 .004], contact: 1 }
in_the_air (pad): { Q: [0 0 .3], joint: rigid, shape: ssBox, size: [.05 .05 .05 .004], contact: 1 }
lying (world): { Q: "t(0 0 .58) d(90 1 0 0)", joint: rigid, shape: cylinder, size: [.1 .03], contact: 1 }
)g");
  return C;
}

const std::vector<std::string> kPlaces = {"table", "pad", "plate", "floor"};

}  // namespace

TEST(PlaceFrames, ThingsStandOnThePlaceThatTheyTouch) {
  const Config C = shelfWithThings();
  EXPECT_EQ(supportingPlace(C, "on_pad", kPlaces), "pad");
  EXPECT_EQ(supportingPlace(C, "on_plate", kPlaces), "plate");
  EXPECT_EQ(supportingPlace(C, "lying", kPlaces), "table");
  EXPECT_EQ(supportingPlace(C, "in_the_air", kPlaces), "");
  EXPECT_FALSE(isOff(C.getFrame("on_pad"), C.getFrame("pad")));
  EXPECT_TRUE(isOff(C.getFrame("on_plate"), C.getFrame("table")));  // a centimeter above it
  EXPECT_TRUE(isOff(C.getFrame("on_pad"), C.getFrame("plate")));    // beside it
}

TEST(PlaceFrames, APlaceIsALevelBoxOrCylinderOfFiveCentimeters) {
  const Config C = shelfWithThings();
  const auto flaw = [&](const char* name) { return placeFlaw(C.getFrame(name), {"lying", "on_pad"}, {}); };
  for (const char* place : {"table", "pad", "plate", "floor", "on_pad"}) EXPECT_EQ(flaw(place), "") << place;
  EXPECT_EQ(flaw("slope"), "it is tilted");
  EXPECT_EQ(flaw("lying"), "it is tilted");
  EXPECT_EQ(flaw("sliver"), "it is 0.040 m wide, and a place has 0.050 m or more");
  EXPECT_EQ(flaw("crate"), "it has no shape; places below it are floor");
}

TEST(PlaceFrames, FactsOfASceneAreWhatStandsWhere) {
  const Config C = shelfWithThings();
  const std::vector<Literal> facts = taskFacts(C);
  EXPECT_TRUE(contains(facts, {"on", {"pad", "on_pad"}}));
  EXPECT_TRUE(contains(facts, {"on", {"pad", "in_the_air"}}));  // nothing is below it: the parent counts
  EXPECT_FALSE(contains(facts, {"is_place", {"plate"}}));  // round things are places if a goal or an object says so
  EXPECT_TRUE(contains(taskFacts(C, {{"on", {"plate", "on_pad"}}}), {"on", {"plate", "on_plate"}}));
}
