#include "kinegraph/task_planning/placements.h"

#include <gtest/gtest.h>

#include "kinegraph/task_planning/polygon.h"
#include "kinegraph/task_planning/shape_points.h"
#include "tests/task_planning/task_scenes.h"

namespace kinegraph {
namespace {

TaskAction putOn(const std::string& place, const std::string& obj) { return {"place", obj, "hand", place}; }

Config traysAndCubes() {
  Config C = cubesOnATable(3);
  C.addFrame("tray", "base",
             "shape: ssBox, size: [.4 .2 .01 .004], rel: [.5 -.5 .005], contact: 1, logical: { is_place }");
  C.addFrame("pad", "base", "shape: ssBox, size: [.06 .06 .01 .004], rel: [-.5 -.5 .005], logical: { is_place }");
  return C;
}

TEST(Placements, OneObjectComesToTheMiddle) {
  const auto placements = placementsOf(traysAndCubes(), {{"pick", "b0", "table", "hand"}, putOn("tray", "b0")});
  ASSERT_EQ(placements.size(), 2u);
  EXPECT_FALSE(placements[0]);
  ASSERT_TRUE(placements[1]);
  EXPECT_LT(placements[1]->at.norm(), 1e-9);
  EXPECT_TRUE(placements[1]->is_whole);
}

TEST(Placements, ObjectsOnOnePlaceArePackedSideBySide) {
  const auto placements =
      placementsOf(traysAndCubes(), {putOn("tray", "b0"), putOn("tray", "b1"), putOn("tray", "b2")});
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(placements[i]->is_whole);
    EXPECT_LT(std::abs(placements[i]->at.x()) + .05, .2);
    for (int j = 0; j < i; ++j) EXPECT_GT((placements[i]->at - placements[j]->at).cwiseAbs().maxCoeff(), .1 + .02);
  }
}

TEST(Placements, AnObjectAvoidsWhatStandsOnItsPlace) {
  Config C = traysAndCubes();
  C.getFrame("b2").setParent(C.getFrame("tray")).setRelativePosition({.1, 0., .055});
  const auto placements = placementsOf(C, {putOn("tray", "b0")});
  EXPECT_TRUE(placements[0]->is_whole);
  EXPECT_LT(placements[0]->at.x(), 0.);
}

TEST(Placements, AnObjectThatIsLargerThanItsPlaceIsNotWhole) {
  const auto placements = placementsOf(traysAndCubes(), {putOn("pad", "b0")});
  EXPECT_FALSE(placements[0]->is_whole);
  EXPECT_LT(placements[0]->at.norm(), 1e-9);
}

TEST(Placements, AnObjectFromElsewhereComesInsideALargePlace) {
  Config C = traysAndCubes();
  C.getFrame("b0").setPosition({-5., .2, 1.});
  const auto placements = placementsOf(C, {putOn("table", "b0")});
  EXPECT_TRUE(placements[0]->is_whole);
  const Eigen::Vector2d half = .5 * placeSides(C.getFrame("table"));
  EXPECT_GT((half - placements[0]->at.cwiseAbs()).minCoeff(), .1);
}

TEST(Placements, OnALargePlaceAnObjectStaysNear) {
  const Config C = traysAndCubes();
  const auto placements = placementsOf(C, {putOn("table", "b0")});
  const Vector3d at = C.getFrame("b0").getRelativePosition();
  EXPECT_TRUE(placements[0]->is_near);
  EXPECT_LT((placements[0]->at - at.head<2>()).norm(), .2);
}

TEST(Polygon, TheDepthOfAPointIsItsDistanceFromTheEdges) {
  const Polygon square = hullOf({{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}, {.5, .5}});
  EXPECT_EQ(square.size(), 4u);
  EXPECT_NEAR(depthIn({.2, .5}, square), .2, 1e-12);
  EXPECT_NEAR(depthIn({1.3, 1.4}, square), -.5, 1e-12);
  EXPECT_NEAR(gapTo({1.3, 1.4}, square), .5, 1e-12);
  EXPECT_EQ(gapTo({.2, .5}, square), 0.);
}

}  // namespace
}  // namespace kinegraph
