#include "kinegraph/features/box.h"

#include <gtest/gtest.h>

#include "tests/features/worked_scene.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

TEST(BoxRegion, AboveABoxAllRowsAreNegative) {
  const Config config = workedScene();
  EXPECT_TRUE(near(value(config, "aboveBox", {"C", "A"}), VectorXd::Constant(4, -.15), 1e-14));
  EXPECT_TRUE(near(value(config, "aboveBox", {"P", "A"}), numbers({.15, -.25, -.45, -.05}), 1e-14));
}

TEST(BoxRegion, InsideLeavesAMarginOfACentimeter) {
  const Config config = workedScene();
  EXPECT_TRUE(near(value(config, "insideBox", {"P", "A"}), numbers({.11, -.29, -.09, -.49, -.09, -.09}), 1e-14));
  EXPECT_TRUE(near(value(config, "insideBox", {"B", "A"}), numbers({-.19, -.69, -.09, -.19, .31, -.09}), 1e-14));
}

TEST(BoxRegion, OfAShapeThatIsNoBoxIsAnError) {
  const Config config = workedScene();
  for (const char* feature : {"aboveBox", "insideBox"}) {
    expectError<ValueError>([&] { value(config, feature, {"A", "B"}); }, {feature, "B", "ssBox"});
  }
}

TEST(StandingAbove, IsZeroForABoxThatStandsOnATable) {
  Config config;
  config.addText("table: { X: [0 0 .7], shape: ssBox, size: [1 1 .1 .01] }");
  config.addText(
      "cup: { X: [.2 .1 .8], shape: ssBox, size: [.1 .1 .1 .01] }  ball: { X: [0 0 1.05], shape: sphere, size: [.2] }");
  EXPECT_NEAR(value(config, "standingAbove", {"cup", "table"})[0], 0., 1e-14);
  EXPECT_NEAR(value(config, "standingAbove", {"ball", "table"})[0], .1, 1e-14);
}
