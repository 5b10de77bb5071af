#include "kinegraph/scene/tree/contact_warnings.h"

#include <gtest/gtest.h>

#include "kinegraph/common/text.h"
#include "kinegraph/scene/config.h"

using namespace kinegraph;

namespace {

/// An arm that stands 3 mm in the floor, and a box near its hand.
Config arm(const std::string& box) {
  Config config;
  config.addText(R"g(
    floor: { X: [0 0 -.05], shape: box, size: [4 4 .1], contact: 1 }
    base: { X: [0 0 .047], shape: box, size: [.2 .2 .1], contact: 1 }
    look (base): { shape: cylinder, size: [.1 .1] }
    arm (base): { pre: [0 0 .3], joint: hingeZ }
    hand (arm): { Q: [.5 0 0], shape: sphere, size: [.1], contact: 1 }
    near: { X: [.5 .3 .2], shape: box, size: [.2 .4 .2], )g" +
                 box + "}\n far: { X: [0 3 0], shape: box, size: [.2 .2 .2] }");
  return config;
}

}  // namespace

TEST(ContactWarnings, NameShapesThatOverlapAtEveryQ) {
  const Config config = arm("contact: 1");
  const ContactWarnings warnings = contactWarnings(*config.scene());
  ASSERT_EQ(warnings.resting.size(), 1u);
  EXPECT_EQ(config.getFrame(warnings.resting[0].first).getName(), "floor");
  EXPECT_EQ(config.getFrame(warnings.resting[0].second).getName(), "base");
  EXPECT_TRUE(warnings.passed_through.empty()) << "what is drawn around the base is not meant, nor what is far";
  ASSERT_EQ(config.contactWarnings().size(), 1u);
  EXPECT_NE(config.contactWarnings()[0].find("'floor' and 'base' overlap at a constant"), std::string::npos);
}

TEST(ContactWarnings, NameShapesThatCollideWithNothing) {
  const Config config = arm("");
  const ContactWarnings warnings = contactWarnings(*config.scene());
  ASSERT_EQ(warnings.passed_through.size(), 1u);
  EXPECT_EQ(config.getFrame(warnings.passed_through[0]).getName(), "near");
  EXPECT_NE(config.report().find("note: 'near' is near moving links"), std::string::npos) << config.report();
  EXPECT_NE(config.report().find("collide: floor base hand"), std::string::npos) << config.report();
}

// An obstacle that stands sunk into a table, below the table or beside it in the tree, is not drawn around the table.
TEST(ContactWarnings, NameObstaclesThatOverlapTheirTable) {
  for (const char* place : {"wall (table): { Q: [.5 0 .35]", "wall (world): { X: [.5 0 .35]", "wall: { X: [.5 0 .35]",
                            "low (table): { Q: [.5 0 .27]"}) {
    const bool is_low = std::string(place).starts_with("low");
    Config config;
    config.addText(cat(R"g(
      world: {}
      table (world): { shape: ssBox, size: [2 2 .1 .02], contact: 1 }
      base (table): { Q: [0 0 .25], shape: box, size: [.2 .2 .4], contact: 1 }
      arm (base): { pre: [0 0 .2], joint: hingeZ }
      hand (arm): { Q: [.5 0 0], shape: sphere, size: [.1], contact: 1 }
    )g",
                       place, ", shape: ssBox, size: ", is_low ? "[.1 .1 .5 .02]" : "[.1 .1 .7 .02]", " }"));
    const std::vector<int> frames = contactWarnings(*config.scene()).passed_through;
    ASSERT_EQ(frames.size(), 1u) << place;
    EXPECT_EQ(config.getFrame(frames[0]).getName(), is_low ? "low" : "wall") << place;
  }
}

// A picture of a table whose top and legs collide: whatever meets it meets them.
TEST(ContactWarnings, SayNothingOfPicturesOfCollidingShapes) {
  Config config;
  config.addText(R"g(
    table: {}
    look (table): { Q: [0 0 -.35], shape: box, size: [1.02 1.02 .74] }
    top (table): { shape: box, size: [1 1 .04], contact: 1 }
    leg (table): { Q: [.45 .45 -.35], shape: box, size: [.06 .06 .7], contact: 1 }
    arm (table): { pre: [0 0 .2], joint: hingeZ }
    hand (arm): { Q: [.3 0 -.05], shape: sphere, size: [.1], contact: 1 }
  )g");
  EXPECT_TRUE(contactWarnings(*config.scene()).passed_through.empty());
}

TEST(ContactWarnings, SayNothingOfShapesThatAreMeant) {
  for (const char* meant : {"simulate", "color: [1 0 0 .3]"}) {
    EXPECT_TRUE(contactWarnings(*arm(meant).scene()).passed_through.empty()) << meant;
  }
}

TEST(Shape, CopiesOfAConfigThatWasNeverUsedShareItsBodies) {
  const Config original = arm("contact: 1");
  Config first(original), second(original);
  first.addFrame("more").setShape(ShapeType::sphere, {.1});
  second.addFrame("more").setShape(ShapeType::sphere, {.2});
  const int frames = original.getFrameDimension();
  for (int i = 0; i < frames; ++i) {
    EXPECT_EQ(first.model()->body[std::size_t(i)], second.model()->body[std::size_t(i)]) << "made once";
    EXPECT_EQ(first.model()->body[std::size_t(i)], original.model()->body[std::size_t(i)]);
  }
  first.getFrame("hand").setShape(ShapeType::sphere, {.3});
  const auto hand = std::size_t(first.getFrame("hand").id());
  EXPECT_NE(first.model()->body[hand], original.model()->body[hand]);
  EXPECT_EQ(first.model()->body[hand]->radius(), .3);
  EXPECT_EQ(second.model()->body[hand]->radius(), .1);
}
