#include "kinegraph/motion/way_search.h"

#include <gtest/gtest.h>

#include "kinegraph/motion/shorten.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {
namespace {

/// A disc that moves in a plane, and a wall with a door of that width.
Config room(double door) {
  Config C;
  C.addText(R"(
world: {}
disc(world): {joint: transXY, limits: [-2, -2, 2, 2]}
body(disc): {shape: cylinder, size: [0.2, 0.2], contact: 1}
)");
  for (const double side : {-1., 1.}) {
    Frame wall = C.addFrame(side > 0. ? "right" : "left");
    wall.setShape(ShapeType::box, {.1, 3., 1.}).setPosition({0., side * (1.5 + .5 * door), 0.});
    wall.setContact(1);
  }
  return C;
}

struct Asked {
  Config C;
  JointSpace space{*C.program()};
  State scene = C.state();

  WayRequest request(int threads = 1, std::uint64_t seed = 0) {
    WayRequest request{
        .demands = {&scene, &space}, .starts = {{VectorXd{{-1., 1.2}}}}, .goals = {{VectorXd{{1., 1.}}}}};
    request.threads = threads;
    request.seed = seed;
    return request;
  }
};

/// Looks every 0.1 mm, posture by posture.
double leastDistance(Config& C, const std::vector<VectorXd>& points) {
  double least = 1.;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const int parts = 1 + int((points[i] - points[i - 1]).norm() / 1e-4);
    for (int k = 0; k <= parts; ++k) {
      C.setJointState(points[i - 1] + double(k) / parts * (points[i] - points[i - 1]));
      for (const Config::NearPair& pair : C.getCollisions(.1)) least = std::min(least, pair.distance);
    }
  }
  return least;
}

TEST(SearchWay, GoesThroughADoorAndIsFreeAtAllTimes) {
  Asked asked{room(.5)};
  const Way way = searchWay(asked.request());
  ASSERT_GE(way.points.size(), 3u);
  EXPECT_FALSE(way.is_line);
  EXPECT_EQ(way.points.front(), (VectorXd{{-1., 1.2}}));
  EXPECT_EQ(way.points.back(), (VectorXd{{1., 1.}}));
  EXPECT_GE(leastDistance(asked.C, way.points), 0.);
}

TEST(SearchWay, ThinWallsAreNotJumpedOver) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Asked asked{room(.5)};
    for (const char* wall : {"left", "right"}) asked.C.getFrame(wall).setShape(ShapeType::box, {1e-3, 3., 1.});
    asked.C.getFrame("body").setShape(ShapeType::cylinder, {.2, .01});
    asked.scene = asked.C.state();
    const Way way = searchWay(asked.request(1, seed));
    ASSERT_FALSE(way.points.empty());
    EXPECT_GE(leastDistance(asked.C, way.points), 0.);
  }
}

TEST(SearchWay, AnswersAreTheSameBitsForAnyNumberOfThreads) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    Asked asked{room(.42)};  // narrow: several attempts
    WayRequest request = asked.request(1, seed);
    const Way one = searchWay(request);
    request.threads = 4;
    const Way four = searchWay(request);
    EXPECT_EQ(one.points, four.points);
    EXPECT_EQ(one.effort, four.effort);
    EXPECT_EQ(one.attempts.size(), four.attempts.size());
  }
}

TEST(SearchWay, WhereNoWayIsTheEffortIsSpentAndWhatWasMetIsKept) {
  Asked asked{room(.3)};
  WayRequest request = asked.request();
  request.effort = 3000;
  const Way way = searchWay(request);
  EXPECT_TRUE(way.points.empty());
  EXPECT_FALSE(way.was_stopped);
  EXPECT_EQ(way.hits.size(), 2u);  // both walls
  EXPECT_GE(way.effort, 3000);
  EXPECT_LT(way.effort, 3200);
}

TEST(SearchWay, TheWatchEndsTheSearch) {
  Asked asked{room(.3)};
  WayRequest request = asked.request(2);
  int asked_for = 0;
  request.watch = [&] { return ++asked_for > 20; };
  const Way way = searchWay(request);
  EXPECT_TRUE(way.points.empty());
  EXPECT_TRUE(way.was_stopped);
}

TEST(SearchWay, TheNearestOfSeveralGoalsThatIsFreeIsTakenByALine) {
  Asked asked{room(.5)};
  WayRequest request = asked.request();
  request.goals = {VectorXd{{1., 1.}}, VectorXd{{-1.5, -1.}}, VectorXd{{-1., 1.5}}};
  const Way way = searchWay(request);
  EXPECT_TRUE(way.is_line);
  EXPECT_EQ(way.goal, 2);
}

TEST(SearchWay, SearchesAndAnswersKeepTheMargin) {
  Asked asked{room(.6)};
  WayRequest request = asked.request();
  request.demands.clearance.margin = .05;
  const Way way = searchWay(request);
  ASSERT_FALSE(way.points.empty());
  EXPECT_GE(leastDistance(asked.C, way.points), .05);
}

TEST(SearchWay, AnEndlessJointMayTurnThroughItsSeam) {
  Config C;
  C.addText(R"(
world: {}
arm(world): {joint: hingeZ}
tip(arm): {shape: box, size: [0.1, 0.1, 0.1], Q: [1, 0, 0], contact: 1}
post(world): {shape: box, size: [0.2, 0.2, 0.2], Q: [1, 0, 0], contact: 1}
)");
  Asked asked{std::move(C)};
  WayRequest request{.demands = {&asked.scene, &asked.space}, .starts = {}, .goals = {}};
  request.starts = {VectorXd{{2.}}};
  request.goals = {VectorXd{{-2.}}};
  const Way way = searchWay(request);  // 4 rad through the post, 2.28 the other way around
  ASSERT_EQ(way.points.size(), 2u);
  EXPECT_NEAR(pathLength(asked.space, asked.space.unroll(way.points)), 2. * M_PI - 4., 1e-12);
}

TEST(Shorten, LeavesTheEndsAndIsFreeAndNearlyTaut) {
  Asked asked{room(.5)};
  WayRequest request = asked.request();
  request.demands.clearance.guard = Clearance::kGuard;
  const Way way = searchWay(request);
  ASSERT_FALSE(way.points.empty());
  Steering steering(request.demands);
  const std::vector<VectorXd> path = shorten(steering, way.points);
  EXPECT_EQ(path.front(), way.points.front());
  EXPECT_EQ(path.back(), way.points.back());
  EXPECT_GE(leastDistance(asked.C, path), 0.);
  const double length = pathLength(asked.space, asked.space.unroll(path));
  EXPECT_LT(length, pathLength(asked.space, asked.space.unroll(way.points)));
  // A taut string around both corners of the door, (-+.05, .25), at the disc's radius: two tangents, two arcs, a line.
  const double to_start = std::hypot(.95, .95), to_goal = std::hypot(.95, .75), r = .2;
  const double arcs =
      1.5 * M_PI - (.75 * M_PI + std::acos(r / to_start)) + .5 * M_PI + (std::atan2(.75, .95) - std::acos(r / to_goal));
  const double taut = std::sqrt(to_start * to_start - r * r) + std::sqrt(to_goal * to_goal - r * r) + r * arcs + .1;
  EXPECT_GT(length, taut);
  EXPECT_LT(length, 1.02 * taut);
}

}  // namespace
}  // namespace kinegraph
