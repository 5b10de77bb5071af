#include "kinegraph/task_planning/pull_start.h"

#include <gtest/gtest.h>

#include "kinegraph/komo/path/path.h"
#include "kinegraph/nlp/nlp.h"
#include "kinegraph/task_planning/task_waypoints.h"
#include "tests/task_planning/task_scenes.h"

namespace kinegraph {
namespace {

const std::vector<TaskAction> kPull = {{"pick", "stick", "table", "gripper"},
                                       {"hook_start", "box", "table", "hook", "stick", "gripper"},
                                       {"hook_end", "box", "hook", "table", "stick", "gripper"},
                                       {"place", "stick", "gripper", "table"},
                                       {"pick", "box", "table", "gripper"}};

/// A hand with fingers that turns about z, in place of one that touches.
Config scene() {
  Config C = stickAndBox(.3);
  C.getFrame("hand").setName("carriage");
  C.addFrame("gripper", "carriage",
             "shape: marker, size: [.03], joint: hingeZ, limits: [-2 2], logical: { is_gripper }, opening: .09");
  return C;
}

TEST(PullStart, ThingsMoveAsTheActionsSay) {
  const Config C = scene();
  for (const std::uint64_t seed : {0, 1, 2}) {
    Rng rng(seed);
    const auto w = makeTaskWaypoints(C, kPull, {"x", "y", "push", "upright", "x"}, defaultTaskRules());
    w->komo().path().setVariables(w->start(seed ? &rng : nullptr));
    const auto at = [&](int slice, const char* name) {
      return w->komo().configuration(slice).getFrame(name).getPosition();
    };
    const Vector3d box = C.getFrame("box").getPosition(), stick = C.getFrame("stick").getPosition();
    EXPECT_LT((at(0, "stick") - stick).norm(), 1e-5) << "taken where it is";
    EXPECT_LT((at(1, "box") - box).norm(), 1e-5) << "not moved by what begins to pull it";
    const Vector3d pulled = at(2, "box") - box;
    EXPECT_LT(pulled.y(), -.05) << "towards the hand";
    EXPECT_LT(std::abs(pulled.x()) + std::abs(pulled.z()), 1e-5) << "along its side, level";
    EXPECT_LT((at(4, "box") - at(2, "box")).norm(), 1e-5) << "taken where it was left";
    EXPECT_LT(at(1, "hook").z(), box.z()) << "low";
  }
}

TEST(PullStart, APullToAnywhereIsTowardsTheHandAlongTheSideThatIsNamed) {
  Config C = scene();
  const TaskAction& end = kPull[2];
  EXPECT_LT((usualPull(C, end, "y") - Vector3d(0., -.2, 0.)).norm(), 1e-12);
  EXPECT_LT((usualPull(C, end, "x") - Vector3d(-.2, 0., 0.)).norm(), 1e-12);
  const Vector3d straight = usualPull(C, end, "touch");
  const Vector3d way = C.getFrame("gripper").getPosition() - C.getFrame("box").getPosition();
  EXPECT_NEAR(straight.norm(), .2, 1e-12);
  EXPECT_EQ(straight.z(), 0.);
  EXPECT_NEAR(straight.x() * way.y(), straight.y() * way.x(), 1e-12);
}

}  // namespace
}  // namespace kinegraph
