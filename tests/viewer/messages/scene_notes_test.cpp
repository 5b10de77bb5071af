#include "kinegraph/viewer/messages/scene_notes.h"

#include <gtest/gtest.h>

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

const SceneNote* ignored(const std::vector<SceneNote>& notes) {
  for (const SceneNote& note : notes) {
    if (note.ignored) return &note;
  }
  return nullptr;
}

}  // namespace

TEST(SceneNotes, SayWhichFramesTheyAreAboutInTheWordsOfTheReport) {
  Config config = arm("");
  config.setJointState(VectorXd::Constant(1, 3.));  // at the box
  const std::vector<SceneNote> notes = sceneNotes(config);
  ASSERT_EQ(notes.size(), 2u);
  ASSERT_TRUE(ignored(notes));
  EXPECT_EQ(ignored(notes)->frames, std::vector<int>{config.getFrame("box").id()});
  for (const SceneNote& note : notes) {
    EXPECT_NE(config.report().find(note.text), std::string::npos) << note.text;
    if (!note.ignored) EXPECT_EQ(note.frames, (std::vector<int>{0, 1})) << "floor and base";
  }
  EXPECT_FALSE(ignored(sceneNotes(arm("contact: 1"))));
}

TEST(SceneNotes, AreOfTheSceneAsABrowserHasChangedIt) {
  const Config config = arm("");
  SceneEdits edits;
  EXPECT_TRUE(edits.notes().empty());
  edits.setScene(config.scene()->snapshot(), 1);
  const auto far = edits.apply(NotesCommand{1});
  ASSERT_TRUE(far && far->notes);
  EXPECT_FALSE(ignored(*far->notes));
  EXPECT_FALSE(edits.apply(SetJointCommand{1, 0, 3.})->notes) << "nobody asked";
  EXPECT_TRUE(ignored(*edits.apply(NotesCommand{1})->notes));
  EXPECT_TRUE(ignored(edits.notes()));
  EXPECT_FALSE(edits.apply(NotesCommand{2})) << "of another structure";
}
