#include "kinegraph/kinematics/lane_kinematics.h"

#include <gtest/gtest.h>

#include "kinegraph/scene/config.h"

namespace kinegraph {
namespace {

/// Two arms with a rotation and a translation each.
Config twoArms() {
  Config config;
  config.addText(R"g(
    base: {}
    a (base): { joint: hingeZ }
    a_end (a): { pre: [.3 0 0], joint: transX }
    b (base): { pre: [0 1 0], joint: hingeY }
    b_end (b): { pre: [.2 0 0], joint: transZ }
  )g");
  return config;
}

TEST(LaneKinematics, HasTheLinksThatMoveTheFramesAndNoOthers) {
  const Config config = twoArms();
  const auto model = config.model();
  const std::vector<int> variable = {-1, -1, 0, 1};  // the joints of the second arm
  const int end = frameId(*model, "b_end", "test");
  const LaneLinks links(*model, *config.parameters(), {end}, variable, 2);
  const LaneRows::Frame place = links.place(*model, *config.parameters(), end);
  const std::vector<int> chain = links.chain(place.link);
  ASSERT_EQ(chain.size(), 2u);
  std::vector<int> variables;
  int turns = 0;
  for (const int column : chain) {
    variables.push_back(links.column(column).variable);
    turns += links.column(column).is_rotation;
  }
  std::sort(variables.begin(), variables.end());
  EXPECT_EQ(variables, (std::vector<int>{0, 1}));
  EXPECT_EQ(turns, 1);
}

TEST(LaneKinematics, RowsAreCountedOneBelowTheOther) {
  LaneRowList list;
  list.addPosition(LaneRows::Block::position, 0);
  list.addPose(1);
  list.addAxisProduct(0, 2, 0, 1);
  list.addTwist(1);
  list.addJoint(3, 2., -1.);
  EXPECT_EQ(list.rows(), 3 + 7 + 1 + 6 + 1);
  int rows = 0;
  for (const LaneRows::Block& block : list.blocks()) rows += block.rows;
  EXPECT_EQ(rows, list.rows());
}

}  // namespace
}  // namespace kinegraph
