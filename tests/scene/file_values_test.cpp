// File values `<...>` of attributes: where they point to once the scene is read.
#include <gtest/gtest.h>

#include <cstdlib>

#include "kinegraph/scene/config.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

/// The file value of attribute `key` of frame a.
std::string fileOf(const Config& config, const char* key) {
  const Node* node = config.getFrame("a").attributes().find(key);
  const AngleText* file = node ? node->value.as<AngleText>() : nullptr;
  return file ? file->text : "none";
}

}  // namespace

TEST(FileValues, AreRelativeToTheFileThatContainsThem) {
  TemporaryFolder folder;
  std::filesystem::create_directories(folder / "inner");
  folder.write("inner/part.g", "a: { x: <there.txt>, missing: <sub/not.txt> }");
  Config config;
  config.addFile(folder.write("outer.g", "Include: <inner/part.g>"));
  EXPECT_EQ(fileOf(config, "x"), (folder / "inner/there.txt").string());
  EXPECT_EQ(fileOf(config, "missing"), (folder / "inner/sub/not.txt").string());
}

TEST(FileValues, TheLastChDirCounts) {
  TemporaryFolder folder;
  std::filesystem::create_directories(folder / "inner");
  Config config;
  config.addText("ChDir: <inner/>\na: { x: <there.txt> }", "a.g", folder.path());
  EXPECT_EQ(fileOf(config, "x"), (folder / "inner/there.txt").string());
}

TEST(FileValues, AbsoluteOnesPackagesAndVariables) {
  setenv("KINEGRAPH_TEST_FOLDER", "/somewhere", 1);
  Config config;
  config.addText(
      "a: { x: </etc/hosts>, y: <package://robot/mesh.stl>, z: <$KINEGRAPH_TEST_FOLDER/k.txt>, home: <~/k> }", "a.g",
      "/here");
  unsetenv("KINEGRAPH_TEST_FOLDER");
  EXPECT_EQ(fileOf(config, "x"), "/etc/hosts");
  EXPECT_EQ(fileOf(config, "y"), "package://robot/mesh.stl");
  EXPECT_EQ(fileOf(config, "z"), "/somewhere/k.txt");
}

TEST(FileValues, TransformsStayTransforms) {
  Config config;
  config.addText("b: {} a (b): { Q: <t(0 0 1)> }", "a.g", "/here");
  EXPECT_EQ(fileOf(config, "Q"), "t(0 0 1)");
  EXPECT_EQ(config.getFrame("a").getPose().p, Vector3d(0., 0., 1.));
}
