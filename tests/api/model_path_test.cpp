#include "kinegraph/api/names.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;

TEST(ModelPath, FindsTheModelsAroundTheLibrary) {
  unsetenv("RAI_PATH");
  const std::string path = modelPath("scenarios/pandaSingle.g");
  EXPECT_TRUE(fs::is_regular_file(path)) << path;
  EXPECT_TRUE(fs::path(path).is_absolute());
  EXPECT_TRUE(fs::is_directory(modelPath("")));
}

TEST(ModelPath, TheEarlierSpellingsMeanTheSameFile) {
  unsetenv("RAI_PATH");
  const std::string path = modelPath("scenarios/pandaSingle.g");
  EXPECT_EQ(raiPath("scenarios/pandaSingle.g"), path);
  EXPECT_EQ(raiPath("../rai-robotModels/scenarios/pandaSingle.g"), path);
  EXPECT_EQ(raiPath("rai-robotModels/scenarios/pandaSingle.g"), path);
}

TEST(ModelPath, AFolderOfTheUsersComesFirstAndThePackagesLast) {
  const TemporaryFolder users, packages;
  std::ofstream(users / "mine.g") << "mine: {}";
  std::ofstream(packages / "theirs.g") << "theirs: {}";
  setenv("RAI_PATH", users.path().c_str(), 1);
  EXPECT_EQ(modelPath("mine.g"), (users / "mine.g").string());
  EXPECT_EQ(modelPath("theirs.g", packages.path().string()), (packages / "theirs.g").string());
  EXPECT_TRUE(fs::exists(modelPath("panda/panda.g")));  // what is not there is looked for in the shipped ones
  unsetenv("RAI_PATH");
}

TEST(ModelPath, AMissingModelIsReportedWithSimilarNames) {
  unsetenv("RAI_PATH");
  expectError<FileError>([] { modelPath("scenarios/pandaSingel.g"); },
                         {"there is no model 'scenarios/pandaSingel.g'", "scenarios/pandaSingle.g"});
}

}  // namespace
}  // namespace kinegraph
