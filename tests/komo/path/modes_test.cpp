#include "kinegraph/komo/path/modes.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

Modes begun(std::size_t slices) {
  Config config;
  config.addText("world: {} box (world): { Q: [1, 0, 0] }");
  Modes modes(slices);
  modes.begin(*config.scene());
  return modes;
}

}  // namespace

TEST(Modes, AreEmptyUntilTheyBegin) {
  EXPECT_TRUE(Modes(4).empty());
  Modes modes = begun(4);
  EXPECT_EQ(modes.list().size(), 1u);
  modes.begin(*modes.at(0).config.scene());
  EXPECT_EQ(modes.list().size(), 1u);
  for (std::size_t slice = 0; slice < 4; ++slice) EXPECT_EQ(&modes.at(slice), modes.list()[0].get());
}

TEST(Modes, AnEditChangesTheSlicesThatItIsForAndNoOthers) {
  Modes modes = begun(5);
  modes.replace(3, 5, [](Mode& mode) { mode.config.getFrame("box").setPosition({2., 0., 0.}); });
  EXPECT_EQ(modes.list().size(), 2u);
  EXPECT_EQ(modes.ofSlices(), (std::vector<int>{0, 0, 0, 1, 1}));
  int edits = 0;
  modes.replace(2, 4, [&](Mode& mode) { mode.config.getFrame("box").setPosition({0., 1. + edits++, 0.}); });
  EXPECT_EQ(edits, 2);  // one copy per mode of the slices
  EXPECT_EQ(modes.ofSlices(), (std::vector<int>{0, 0, 2, 3, 1}));
  const auto x = [&](std::size_t slice) { return Vector3d(modes.at(slice).config.getFrame("box").getPose().p); };
  EXPECT_EQ(x(1), Vector3d(1., 0., 0.));
  EXPECT_EQ(x(2), Vector3d(0., 1., 0.));
  EXPECT_EQ(x(3), Vector3d(0., 2., 0.));
  EXPECT_EQ(x(4), Vector3d(2., 0., 0.));
}

TEST(Modes, AFrameIsAddedToAllUnderOneId) {
  Modes modes = begun(3);
  modes.replace(1, 3, [](Mode&) {});
  const int id = modes.addFrame("seat");
  for (const auto& mode : modes.list()) EXPECT_EQ(mode->config.getFrame("seat").id(), id);
}

TEST(Modes, AClonesEditsAreItsOwn) {
  Modes modes = begun(2);
  Modes clone = modes.clone();
  clone.addFrame("seat");
  EXPECT_TRUE(clone.at(0).config.findFrame("seat").has_value());
  EXPECT_FALSE(modes.at(0).config.findFrame("seat").has_value());
}

TEST(Modes, AModeThatIsNotThereIsRefused) {
  expectError<ValueError>([] { Modes({Mode{}}, {0, 0, 1}, 1); }, {"slice 2", "mode 1 of 1"});
}
