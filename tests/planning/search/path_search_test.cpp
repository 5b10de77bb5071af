#include "kinegraph/planning/search/path_search.h"

#include <gtest/gtest.h>

#include "kinegraph/planning/smoothing/shortcut.h"
#include "tests/planning/plane_room.h"

namespace kinegraph {
namespace {

TEST(SearchPath, GoesThroughADoorAndIsFreeAtAllTimes) {
  Asked asked{room(.5)};
  const PathSearchResult found = searchPath(asked.request());
  ASSERT_GE(found.points.size(), 3u);
  EXPECT_FALSE(found.is_line);
  EXPECT_EQ(found.points.front(), (VectorXd{{-1., 1.2}}));
  EXPECT_EQ(found.points.back(), (VectorXd{{1., 1.}}));
  EXPECT_GE(leastDistance(asked.C, found.points), 0.);
}

TEST(SearchPath, ThinWallsAreNotJumpedOver) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Asked asked{room(.5)};
    for (const char* wall : {"left", "right"}) asked.C.getFrame(wall).setShape(ShapeType::box, {1e-3, 3., 1.});
    asked.C.getFrame("body").setShape(ShapeType::cylinder, {.2, .01});
    asked.scene = asked.C.state();
    const PathSearchResult found = searchPath(asked.request(1, seed));
    ASSERT_FALSE(found.points.empty());
    EXPECT_GE(leastDistance(asked.C, found.points), 0.);
  }
}

TEST(SearchPath, AnswersAreTheSameBitsForAnyNumberOfThreads) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    Asked asked{room(.42)};  // narrow: several searches
    PathQuery request = asked.request(1, seed);
    const PathSearchResult one = searchPath(request);
    request.threads = 4;
    const PathSearchResult four = searchPath(request);
    EXPECT_EQ(one.points, four.points);
    EXPECT_EQ(one.evaluations, four.evaluations);
    EXPECT_EQ(one.searches.size(), four.searches.size());
  }
}

TEST(SearchPath, WhereNoWayIsTheEffortIsSpentAndWhatWasMetIsKept) {
  Asked asked{room(.3)};
  PathQuery request = asked.request();
  request.max_evaluations = 3000;
  const PathSearchResult found = searchPath(request);
  EXPECT_TRUE(found.points.empty());
  EXPECT_FALSE(found.was_stopped);
  EXPECT_EQ(found.hits.size(), 2u);  // both walls
  EXPECT_GE(found.evaluations, 3000);
  EXPECT_LT(found.evaluations, 3200);
}

TEST(SearchPath, TheWatchEndsTheSearch) {
  Asked asked{room(.3)};
  PathQuery request = asked.request(2);
  int asked_for = 0;
  request.cancellation = [&] { return ++asked_for > 20; };
  const PathSearchResult found = searchPath(request);
  EXPECT_TRUE(found.points.empty());
  EXPECT_TRUE(found.was_stopped);
}

TEST(SearchPath, TheNearestOfSeveralGoalsThatIsFreeIsTakenByALine) {
  Asked asked{room(.5)};
  PathQuery request = asked.request();
  request.goals = {VectorXd{{1., 1.}}, VectorXd{{-1.5, -1.}}, VectorXd{{-1., 1.5}}};
  const PathSearchResult found = searchPath(request);
  EXPECT_TRUE(found.is_line);
  EXPECT_EQ(found.goal, 2);
}

TEST(SearchPath, SearchesAndAnswersKeepTheMargin) {
  Asked asked{room(.6)};
  PathQuery request = asked.request();
  request.constraints.clearance.margin = .05;
  const PathSearchResult found = searchPath(request);
  ASSERT_FALSE(found.points.empty());
  EXPECT_GE(leastDistance(asked.C, found.points), .05);
}

TEST(SearchPath, AnEndlessJointMayTurnThroughItsSeam) {
  Config C;
  C.addText(R"(
world: {}
arm(world): {joint: hingeZ}
tip(arm): {shape: box, size: [0.1, 0.1, 0.1], Q: [1, 0, 0], contact: 1}
post(world): {shape: box, size: [0.2, 0.2, 0.2], Q: [1, 0, 0], contact: 1}
)");
  Asked asked{std::move(C)};
  PathQuery request{.constraints = {&asked.scene, &asked.space}, .starts = {}, .goals = {}};
  request.starts = {VectorXd{{2.}}};
  request.goals = {VectorXd{{-2.}}};
  const PathSearchResult found = searchPath(request);  // 4 rad through the post, 2.28 in the other direction
  ASSERT_EQ(found.points.size(), 2u);
  EXPECT_NEAR(pathLength(asked.space, asked.space.unroll(found.points)), 2. * M_PI - 4., 1e-12);
}

TEST(Shorten, LeavesTheEndsAndIsFreeAndNearlyTaut) {
  Asked asked{room(.5)};
  PathQuery request = asked.request();
  request.constraints.clearance.guard = Clearance::kGuard;
  const PathSearchResult found = searchPath(request);
  ASSERT_FALSE(found.points.empty());
  Steering steering(request.constraints);
  const std::vector<VectorXd> path = shortcutPath(steering, found.points);
  EXPECT_EQ(path.front(), found.points.front());
  EXPECT_EQ(path.back(), found.points.back());
  EXPECT_GE(leastDistance(asked.C, path), 0.);
  const double length = pathLength(asked.space, asked.space.unroll(path));
  EXPECT_LT(length, pathLength(asked.space, asked.space.unroll(found.points)));
  const double tightened = tightenedLength();
  EXPECT_GT(length, tightened);
  EXPECT_LT(length, 1.02 * tightened);
}

}  // namespace
}  // namespace kinegraph
