#include "kinegraph/common/file_paths.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

class FilePaths : public ::testing::Test {
 protected:
  void SetUp() override { unsetenv("ROS_PACKAGE_PATH"); }
  void TearDown() override { unsetenv("ROS_PACKAGE_PATH"); }

  std::string write(const std::string& name) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    return folder_.write(name, "<package><name>arm_description</name></package>");
  }
  std::string found(const std::string& name) { return locateFile(name, folder_.path().string()).path; }

  TemporaryFolder folder_;
};

}  // namespace

TEST_F(FilePaths, NamesAreReadAsWrittenBeforeAnythingIsReplaced) {
  for (const char* name : {"m$x.stl", "100%.stl", "a%20b.stl", "c\\d.stl"}) EXPECT_EQ(found(name), write(name)) << name;
}

TEST_F(FilePaths, PercentsBackslashesAndCapitalsLeadToTheFileThatExists) {
  const std::string blank = write("m/a b.stl");
  EXPECT_EQ(found("m/a%20b.stl"), blank);
  EXPECT_EQ(found("file://m\\a%20b.stl"), blank);
  EXPECT_TRUE(locateFile("m/a%20b.stl", folder_.path().string()).assumption.empty());
  const LocatedFile other = locateFile("M/A b.STL", folder_.path().string());
  EXPECT_EQ(other.path, blank);
  EXPECT_NE(other.assumption.find("'a b.stl' is read instead"), std::string::npos);
}

TEST_F(FilePaths, PackagesAreFoundAnywhereBelowTheFoldersOfRos) {
  const std::string elsewhere = (folder_ / "elsewhere").string();
  for (const char* place : {"a/src/arm_description", "b/src/vendor/arm_description", "c/src/arm-main"}) {
    write(std::string(place) + "/package.xml");
    const std::string mesh = write(std::string(place) + "/meshes/t.stl");
    setenv("ROS_PACKAGE_PATH", (folder_ / std::string(place).substr(0, 5)).c_str(), 1);
    EXPECT_EQ(resolvePath("package://arm_description/meshes/t.stl", elsewhere), mesh);
    EXPECT_EQ(resolvePath("$(find arm_description)/meshes/t.stl", elsewhere), mesh);
  }
  write("d/src/ignored/CATKIN_IGNORE");
  write("d/src/ignored/arm/package.xml");
  write("d/src/ignored/arm/meshes/u.stl");
  setenv("ROS_PACKAGE_PATH", (folder_ / "d/src").c_str(), 1);
  EXPECT_EQ(resolvePath("package://arm_description/meshes/u.stl", elsewhere), "");
}

TEST_F(FilePaths, ARobotOfARenamedPackageFindsItsMeshesWithAnAssumption) {
  const std::string mesh = write("robot/meshes/t.stl");
  const LocatedFile file = locateFile("package://other/meshes/t.stl", (folder_ / "robot/urdf").string());
  EXPECT_EQ(file.path, mesh);
  EXPECT_NE(file.assumption.find("package 'other' is not found"), std::string::npos);
}
