#include "kinegraph/features/registry.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/features/worked_scene.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

TEST(Registry, HasEveryNumberOfThePythonEnumAndNamesOnlyOnce) {
  std::set<int> numbers;
  std::set<std::string> names;
  for (const FeatureInfo& info : featureRegistry()) {
    numbers.insert(int(info.symbol));
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_EQ(featureSymbolFromName(info.name), info.symbol);
  }
  for (int number = 0; number <= 55; ++number) EXPECT_EQ(numbers.count(number), number == 32 ? 0u : 1u) << number;
}

TEST(Registry, KnowsTheAliases) {
  EXPECT_EQ(featureSymbolFromName("negDistance"), featureSymbolFromName("distance"));
  EXPECT_EQ(featureSymbolFromName("jointState"), featureSymbolFromName("qItself"));
}

TEST(Registry, SuggestsTheNearestNameForAnUnknownOne) {
  expectError<NameError>([] { featureSymbolFromName("positonDiff"); }, {"'positonDiff'", "positionDiff"});
  expectError<NameError>([] { featureSymbolFromName("vectorx"); }, {"'vectorx'", "vectorX"});
  expectError<NameError>([] { featureInfo(FeatureSymbol(32)); }, {"32"});
}

TEST(Registry, ASymbolThatIsNotAvailableSaysSo) {
  const Config config = workedScene();
  for (const FeatureInfo& info : featureRegistry()) {
    if (info.available) continue;
    const std::vector<std::string> frames(std::size_t(std::max(info.min_frames, 0)), "A");
    expectError<ValueError>([&] { eval(config, info.symbol, frames); },
                            {info.name.c_str(), "is obsolete; use position"});
  }
}

TEST(Registry, AWrongNumberOfFramesIsAnErrorThatSaysHowManyItTakes) {
  const Config config = workedScene();
  int checked = 0;
  for (const FeatureInfo& info : featureRegistry()) {
    std::vector<int> wrong;
    if (info.min_frames > 0) wrong.push_back(info.min_frames - 1);
    if (info.max_frames >= 0) wrong.push_back(info.max_frames + 1);
    for (int count : wrong) {
      const std::vector<std::string> frames(std::size_t(count), "A");
      const std::string takes = featureInfo(info.symbol).name + " takes " + std::to_string(info.min_frames),
                        got = "got " + std::to_string(count);
      expectError<ValueError>([&] { value(config, info.name.c_str(), frames); }, {takes.c_str(), got.c_str()});
      ++checked;
    }
  }
  EXPECT_GT(checked, 80);
}

TEST(Registry, AFrameThatIsNotThereIsNamedWithTheFeatureAndSimilarNames) {
  Config config = workedScene();
  config.addFrame("gripper");
  expectError<FrameNotFound>(
      [&] {
        value(config, "positionDiff", {"A", "griper"});
      },
      {"positionDiff", "'griper'", "gripper"});
}
