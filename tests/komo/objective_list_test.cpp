#include "kinegraph/komo/objective_list.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

Path tenSlices(int order) {
  Config config;
  config.addText("world: {} arm (world): { joint: hingeZ } tip (arm): { Q: [1, 0, 0] }");
  Path path;
  path.setScene(config);
  path.setGrid(TimeGrid(1., 10, 1., order));
  return path;
}

Objective positionAt(std::vector<double> times) {
  return {.feature = FeatureSymbol::position, .frames = {"tip"}, .type = ObjectiveType::eq, .times = std::move(times)};
}

}  // namespace

TEST(ObjectiveList, KnowsTheSlicesAndTheOrderOfEach) {
  const Path path = tenSlices(2);
  ObjectiveList list;
  list.add(positionAt({.5, 1.}), path, {});
  list.add({.feature = FeatureSymbol::angularVel, .frames = {"tip"}, .type = ObjectiveType::sos}, path, {});
  list.add(positionAt({.5, 1.}), path, {}, 2, -1);
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(std::pair(list[0].from, list[0].to), std::pair(4, 9));
  EXPECT_EQ(std::pair(list[1].from, list[1].to), std::pair(0, 9));
  EXPECT_EQ(std::pair(list[2].from, list[2].to), std::pair(6, 8));
  EXPECT_EQ(list[0].order, 0);
  EXPECT_EQ(list[1].order, 1);  // its own order is 1
  EXPECT_EQ(list[1].name(), "angularVel");
  EXPECT_TRUE(list.takeWarnings().empty());
}

TEST(ObjectiveList, OneThatSelectsNothingIsListedAndWarnedOfOnce) {
  const Path path = tenSlices(0);
  ObjectiveList list;
  list.add(positionAt({3.}), path, {});
  EXPECT_EQ(list.size(), 1u);
  EXPECT_GT(list[0].from, list[0].to);
  const std::vector<std::string> warnings = list.takeWarnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("position with times [3] selects no slice; the 10 slices are at phase times 0.1 to 1"),
            std::string::npos)
      << warnings[0];
  EXPECT_TRUE(list.takeWarnings().empty());
}

TEST(ObjectiveList, OneThatDoesNotFitIsRefusedAndNotListed) {
  const Path path = tenSlices(1);
  ObjectiveList list;
  Objective objective = positionAt({});
  objective.order = 2;
  expectError<ValueError>([&] { list.add(objective, path, {}); }, {"position of order 2", "this one has 1"});
  objective = positionAt({});
  objective.frames = {"tap"};
  expectError<FrameNotFound>([&] { list.add(objective, path, {}); }, {"'tap'", "tip"});
  objective = positionAt({});
  objective.target = VectorXd::Zero(2);
  expectError<ValueError>([&] { list.add(objective, path, {}); }, {"target of position has 2"});
  EXPECT_TRUE(list.empty());
}
