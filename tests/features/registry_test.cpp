#include "kinegraph/features/feature_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "kinegraph/features/feature.h"
#include "tests/features/worked_scene.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

TEST(Registry, HasEveryNumberOfThePythonEnumAndNamesOnlyOnce) {
  std::set<int> numbers;
  std::set<std::string> names;
  for (const FeatureInfo& info : featureRegistry()) EXPECT_TRUE(numbers.insert(int(info.symbol)).second) << info.name;
  for (const auto& [name, symbol] : featureNames()) {
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_EQ(featureSymbolFromName(name), symbol);
  }
  for (int number = 0; number <= 55; ++number) EXPECT_EQ(numbers.count(number), number == 32 ? 0u : 1u) << number;
}

/// The frames of the worked scene for each feature.
std::vector<int> someFrames(const FeatureInfo& info, const Config& config) {
  std::vector<int> ids;
  for (const char* name : {"box", "ball", "wall"}) ids.push_back(config.getFrame(name).id());
  ids.resize(std::size_t(info.max_frames < 0 ? info.min_frames : info.max_frames));
  return ids;
}

TEST(Registry, SaysHowManyFramesAndRowsThereAreAndOfWhichOrderTheyAre) {
  Config config;
  config.addText(R"(
    world: {}
    box (world): { joint: free, shape: ssBox, size: [.1, .1, .1, .01], contact: 1, mass: 1 }
    ball (world): { Q: [1, 0, 0], joint: hingeX, shape: ssBox, size: [.1, .1, .1, .01], contact: 1, mass: 1 }
    wall (world): { Q: [2, 0, 0], shape: ssBox, size: [.1, .1, .1, .01], contact: 1 }
  )");
  int fixed = 0;
  for (const FeatureInfo& info : featureRegistry()) {
    if (!info.available()) continue;
    const auto words = [](const std::string& text) {
      return text.empty() ? 0 : 1 + int(std::count(text.begin(), text.end(), ' '));
    };
    EXPECT_TRUE(info.max_frames < 0 || words(info.frames) == info.max_frames) << info.name;
    EXPECT_LE(info.min_frames, info.max_frames < 0 ? 2 : info.max_frames) << info.name;
    const auto feature = makeFeature(info.symbol, someFrames(info, config), *config.model());
    EXPECT_EQ(feature->order(), info.order) << info.name;
    const std::string rows = info.rows;
    if (rows.find(' ') != std::string::npos) continue;  // depends on the scene
    EXPECT_EQ(feature->rows(), std::stoi(rows)) << info.name;
    ++fixed;
  }
  EXPECT_GT(fixed, 45);
}

TEST(Registry, EachRowHasAUnit) {
  for (const FeatureInfo& info : featureRegistry()) {
    const bool has_none = info.symbol == FeatureSymbol::qQuaternionNorms || !info.available();
    for (int row : {0, 2, 3, 5}) EXPECT_EQ(std::string(unitName(info.unitOf(row))) == "-", has_none) << info.name;
  }
  EXPECT_EQ(featureInfo(FeatureSymbol::poseRel).unitOf(2), FeatureUnit::meter);
  EXPECT_EQ(featureInfo(FeatureSymbol::poseRel).unitOf(3), FeatureUnit::quaternion);
  EXPECT_EQ(featureInfo(FeatureSymbol::scalarProductZY).unitOf(0), FeatureUnit::cosine);
}

/// KINEGRAPH_UPDATE_DOCS=1 rewrites the table.
TEST(Registry, TheTableInTheDocumentsIsThatOfTheRegistry) {
  const std::string path = std::string(KINEGRAPH_SOURCE_DIR) + "/docs/features.md";
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  const std::string page = text.str();
  const std::size_t first = page.find("| feature | frames |"), end = page.find("\n\n", first);
  ASSERT_NE(end, std::string::npos);
  const std::string table = page.substr(first, end + 1 - first);
  if (std::getenv("KINEGRAPH_UPDATE_DOCS"))
    std::ofstream(path) << page.substr(0, first) << featureTable() << page.substr(end + 1);
  EXPECT_EQ(table, featureTable()) << "run this test with KINEGRAPH_UPDATE_DOCS=1";
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
    if (info.available()) continue;
    const std::vector<std::string> frames(std::size_t(std::max(info.min_frames, 0)), "A");
    expectError<ValueError>([&] { eval(config, info.symbol, frames); },
                            {info.name.c_str(), "is obsolete; use position"});
  }
}

TEST(Registry, AWrongNumberOfFramesIsAnErrorThatSaysHowManyItTakes) {
  const Config config = workedScene();
  int checked = 0;
  for (const auto& [name, symbol] : featureNames()) {
    const FeatureInfo& info = featureInfo(symbol);
    std::vector<int> wrong;
    if (info.min_frames > 0) wrong.push_back(info.min_frames - 1);
    if (info.max_frames >= 0) wrong.push_back(info.max_frames + 1);
    for (int count : wrong) {
      const std::vector<std::string> frames(std::size_t(count), "A");
      const std::string takes = info.name + " takes " + std::to_string(info.min_frames),
                        got = "got " + std::to_string(count);
      expectError<ValueError>([&] { value(config, name.c_str(), frames); }, {takes.c_str(), got.c_str()});
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
