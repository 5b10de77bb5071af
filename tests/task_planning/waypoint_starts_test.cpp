#include <gtest/gtest.h>

#include "kinegraph/komo/path/path.h"
#include "kinegraph/task_planning/task_waypoints.h"
#include "tests/task_planning/task_scenes.h"

namespace kinegraph {
namespace {

TEST(WaypointStarts, SampledPlacementsOnADiskAreOnIt) {
  Config C = cubesOnATable(1);
  C.addFrame("disk", "table", "shape: cylinder, size: [.02 .2], contact: 1, rel: [.5 .5 .06], logical: { is_place }");
  TaskWaypoints waypoints(C, {{"pick", "b0", "table", "hand"}, {"place", "b0", "hand", "disk"}}, {"touch", ""});
  waypoints.attach(1., "hand", "b0");
  waypoints.put(2., "b0", "disk");
  Rng rng(3);
  for (int k = 0; k < 20; ++k) {
    waypoints.m->komo->path().setVariables(waypoints.start(&rng, true));
    const Vector3d away = waypoints.m->komo->configuration(1).getFrame("b0").getPosition() - Vector3d(.5, .5, .6);
    ASSERT_TRUE(away.allFinite());
    EXPECT_LT(away.head<2>().norm(), .2);
  }
}

}  // namespace
}  // namespace kinegraph
