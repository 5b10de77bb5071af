#include "kinegraph/viewer/messages/scene_warnings.h"

#include <gtest/gtest.h>

#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/viewer/scene_edits.h"

using namespace kinegraph;

namespace {

/// An arm that stands 3 mm in the floor; it can turn to a box.
Config arm(const std::string& box) {
  Config config;
  config.addText(R"g(
    floor: { X: [0 0 -.05], shape: box, size: [4 4 .1], contact: 1 }
    base: { X: [0 0 .047], shape: box, size: [.2 .2 .1], contact: 1 }
    arm (base): { pre: [0 0 .3], joint: hingeZ }
    hand (arm): { Q: [.5 0 0], shape: sphere, size: [.1], contact: 1 }
    box: { X: [-.5 .3 .2], shape: box, size: [.2 .4 .2], )g" +
                 box + "}");
  return config;
}

const SceneWarning* ignored(const std::vector<SceneWarning>& warnings) {
  for (const SceneWarning& warning : warnings) {
    if (warning.ignored) return &warning;
  }
  return nullptr;
}

}  // namespace

TEST(SceneWarnings, NameTheirFramesInTheWordsOfTheReport) {
  Config config = arm("");
  config.setJointState(VectorXd::Constant(1, 3.));  // at the box
  const std::vector<SceneWarning> warnings = sceneWarnings(config);
  ASSERT_EQ(warnings.size(), 2u);
  ASSERT_TRUE(ignored(warnings));
  EXPECT_EQ(ignored(warnings)->frames, std::vector<int>{config.getFrame("box").id()});
  for (const SceneWarning& warning : warnings) {
    EXPECT_NE(config.report().find(warning.text), std::string::npos) << warning.text;
    if (!warning.ignored) EXPECT_EQ(warning.frames, (std::vector<int>{0, 1})) << "floor and base";
  }
  EXPECT_FALSE(ignored(sceneWarnings(arm("contact: 1"))));
}

TEST(SceneWarnings, AreOfTheEditedScene) {
  const Config config = arm("");
  SceneEdits edits;
  EXPECT_TRUE(edits.warnings().empty());
  edits.setScene(config.scene()->snapshot(), 1);
  const auto far = edits.apply(WarningsCommand{1});
  ASSERT_TRUE(far && far->warnings);
  EXPECT_FALSE(ignored(*far->warnings));
  EXPECT_FALSE(edits.apply(SetJointCommand{1, 0, 3.})->warnings) << "nobody asked";
  EXPECT_TRUE(ignored(*edits.apply(WarningsCommand{1})->warnings));
  EXPECT_TRUE(ignored(edits.warnings()));
  EXPECT_FALSE(edits.apply(WarningsCommand{2})) << "of another structure";
}
