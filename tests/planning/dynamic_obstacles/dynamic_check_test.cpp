#include "kinegraph/planning/dynamic_obstacles/dynamic_check.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/trajectories/retime.h"
#include "tests/planning/dynamic_room.h"

namespace kinegraph {
namespace {

TEST(DynamicScene, AnObstacleGoesStraightBetweenItsPosesAndStandsBeforeAndAfter) {
  const DynamicScene scene(discAndBox(), {moves("cart", {{1., poseAt(0., 0.)}, {3., poseAt(1., 2., M_PI)}})}, "test");
  EXPECT_TRUE(scene.valuesAt(0, 0.).isApprox(poseAt(0., 0.)));
  EXPECT_TRUE(scene.valuesAt(0, 2.).isApprox(poseAt(.5, 1., .5 * M_PI)));
  EXPECT_TRUE(scene.valuesAt(0, 9.).isApprox(poseAt(1., 2., M_PI)));
  EXPECT_EQ(scene.breaks(), (std::vector<double>{0., 1., 3.}));
}

TEST(DynamicScene, CopiesStandWhereTheObstacleIsAtTheTimesThatAreAsked) {
  const DynamicScene scene(discAndBox(), {moves("cart", {{0., poseAt(0., 0.)}, {2., poseAt(2., 0.)}})}, "test");
  Config C = scene.staticScene({1.});
  C.setJointState(VectorXd{{1., 0.}});
  ASSERT_EQ(C.getCollisions().size(), 1u);
  EXPECT_TRUE(C.getFrame("box at 1 s").getPosition().isApprox(Vector3d(1., 0., 0.)));
  C.setJointState(VectorXd{{0., 0.}});
  EXPECT_TRUE(C.getCollisions().empty());
  EXPECT_TRUE(scene.staticScene().getCollidablePairs().empty());
}

TEST(DynamicScene, WhatMakesNoSenseIsRefused) {
  const Config C = discAndBox();
  const auto made = [&](const ObstacleTrajectory& obstacle) { DynamicScene(C, {obstacle}, "test"); };
  EXPECT_THROW(made(moves("disc", {{0., poseAt(0., 0.)}})), ValueError);
  EXPECT_THROW(made(moves("world", {{0., poseAt(0., 0.)}})), ValueError);
  EXPECT_THROW(made(moves("cart", {{0., VectorXd{{1., 2.}}}})), ValueError);
  EXPECT_THROW(made(moves("cart", {{1., poseAt(0., 0.)}, {1., poseAt(1., 0.)}})), ValueError);
  EXPECT_THROW(made(moves("nothing", {{0., poseAt(0., 0.)}})), FrameNotFound);
}

/// Random motions around corners, and rotating obstacles.
TEST(DynamicCheck, WhatItCallsFreeIsFreeAndWhatItMeetsIsNear) {
  const Config C = discAndBox();
  int free = 0, met = 0;
  for (int seed = 0; seed < 60; ++seed) {
    Rng rng{std::uint64_t(seed)};
    MatrixXd path(4, 2);
    for (double& value : path.reshaped()) value = rng.uniform(-1.5, 1.5);
    const MotionLimits limits{VectorXd::Constant(2, 1.), VectorXd::Constant(2, 2.), {}};
    const TimedPath timed = retime(path, limits, {.tolerance = .1});
    std::vector<std::pair<double, VectorXd>> track;
    for (int k = 0; k < 4; ++k)
      track.push_back({1.3 * k, poseAt(rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5), rng.uniform(-3., 3.))});
    const std::vector<ObstacleTrajectory> obstacles = {moves("cart", track)};
    const DynamicScene scene(C, obstacles, "test");
    DynamicCheck check(scene, .01);
    const std::optional<DynamicContact> contact = check.contact(timed.curve(), timed.scaling(), limits.acceleration);
    MotionPlan plan;
    plan.status = PlanStatus::solved;
    plan.timed_path = timed;
    const double least = leastOfTime(C, plan, obstacles, 1e-3, 0.);
    if (!contact) {
      EXPECT_GE(least, .01 - 1e-9) << seed;
      ++free;
    } else {
      EXPECT_LE(least, .01 + 3. * DynamicCheck::kLeastSlack) << seed;
      ++met;
    }
  }
  EXPECT_GE(free, 10);
  EXPECT_GE(met, 10);
}

}  // namespace
}  // namespace kinegraph
