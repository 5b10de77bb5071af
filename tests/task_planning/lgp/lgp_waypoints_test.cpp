#include "kinegraph/task_planning/lgp/lgp_waypoints.h"

#include "kinegraph/komo/path/path.h"
#include "tests/task_planning/lgp/lgp_scenes.h"

namespace kinegraph {
namespace {

TEST(LgpWaypoints, TheShortestBeginningThatFailsIsFoundAndRemembered) {
  const LgpProblem problem("unblock");
  Reaches tamp(problem.C, {});
  const LgpOptions options;
  LgpWaypoints waypoints(problem.C, tamp, options);
  const TaskAction low = {"reach", "0.9"}, high = {"reach", "50"};
  EXPECT_EQ(waypoints.failing({low, high, low}), 2u);
  const int solves = waypoints.solves;
  EXPECT_GT(solves, 0);
  EXPECT_EQ(waypoints.failing({low, high, low}), 2u);
  EXPECT_EQ(waypoints.failing({low, high}), 2u);
  EXPECT_EQ(waypoints.solves, solves);
  EXPECT_FALSE(waypoints.failing({low, low}));
  EXPECT_EQ(waypoints.komo->slices(), 2);
  EXPECT_EQ(waypoints.x, waypoints.komo->path().variables());
}

TEST(LgpWaypoints, CausesAreCountedTheMostFrequentFirst) {
  const LgpProblem problem("unblock");
  Reaches tamp(problem.C, {});
  const LgpOptions options;
  LgpWaypoints waypoints(problem.C, tamp, options);
  const TaskAction low = {"reach", "0.9"}, high = {"reach", "50"}, higher = {"reach", "60"};
  waypoints.failing({higher});
  waypoints.failing({low, high});
  const auto causes = waypoints.causes();
  ASSERT_EQ(causes.size(), 2u);
  for (const auto& [cause, count] : causes) EXPECT_GE(count, 1);
  EXPECT_GE(causes[0].second, causes[1].second);
  EXPECT_EQ(causes[0].first.rfind("(reach ", 0), 0u) << causes[0].first;
  const int solves = waypoints.solves;
  EXPECT_FALSE(waypoints.tryAgain({high}, 1));
  EXPECT_GT(waypoints.solves, solves);
  EXPECT_EQ(waypoints.causes(), causes);  // they are told once
}

}  // namespace
}  // namespace kinegraph
