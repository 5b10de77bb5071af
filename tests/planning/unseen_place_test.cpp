#include <gtest/gtest.h>

#include "kinegraph/geometry/shapes/cells.h"
#include "kinegraph/planning/plan_motion.h"
#include "kinegraph/scene/collisions.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {
namespace {

constexpr double kSide = .05;  // m

/// A ball that moves in a plane, and a wall of cells across x = 0 with a gap at y = .5.
Config ballAndWall(float gap, float other = CellKind::occupied) {
  Config C;
  C.addText(R"(
    world: {}
    slider(world): { joint: transX, limits: [-1, 1] }
    ball(slider): { joint: transY, limits: [-1, 1], shape: sphere, size: [.08], contact: 1 }
  )");
  Grid grid{{2, 44, 4}, std::vector<float>(2 * 44 * 4, other)};
  for (int i = 0; i < 2; ++i) {
    for (int j = 30; j < 34; ++j) {  // y from .4 to .6
      for (int k = 0; k < 4; ++k) grid.values[std::size_t((i * 44 + j) * 4 + k)] = gap;
    }
  }
  Frame map = C.addFrame("map");
  setCells(map, grid, {2 * kSide, 44 * kSide, 4 * kSide});
  map.setContact(1);
  C.setJointState(VectorXd{{-.6, 0.}});
  return C;
}

MotionPlan planAcross(const Config& C) {
  PlanOptions options;
  options.max_evaluations = 3000;  // enough for the gap
  return planMotion(C, MotionGoal(VectorXd{{.6, 0.}}), options);
}

TEST(UnseenPlace, IsTheGapThatNoCameraHasSeen) {
  const MotionPlan plan = planAcross(ballAndWall(CellKind::unseen));
  EXPECT_FALSE(plan.feasible());
  ASSERT_TRUE(plan.blockedByUnseen);
  const UnseenPlace& place = *plan.blockedByUnseen;
  EXPECT_EQ(place.frame, "ball");
  EXPECT_NEAR(place.position.y(), .5, .1);
  EXPECT_NEAR(place.position.x(), -.025, 1e-9);  // the side of the start
  EXPECT_EQ(place.position, place.cells.front());
  EXPECT_LE(std::abs(place.q[0]), .05 + .08);
  EXPECT_GT(place.depth, .02);
  EXPECT_LT(place.depth, .11);
  for (const Vector3d& cell : place.cells) {
    EXPECT_GT(cell.y(), .4);
    EXPECT_LT(cell.y(), .6);
  }
  EXPECT_NE(plan.message.find("unseen space"), std::string::npos) << plan.message;
}

TEST(UnseenPlace, IsNoneIfOccupiedCellsAreInTheWayToo) {
  EXPECT_FALSE(planAcross(ballAndWall(CellKind::occupied)).blockedByUnseen);
  const MotionPlan free = planAcross(ballAndWall(CellKind::free));
  EXPECT_TRUE(free.feasible()) << free.message;
  EXPECT_FALSE(free.blockedByUnseen);
}

TEST(UnseenPlace, IsNoneIfAMotionAroundItExists) {
  const MotionPlan plan = planAcross(ballAndWall(CellKind::free, CellKind::unseen));
  EXPECT_TRUE(plan.feasible()) << plan.message;
  EXPECT_FALSE(plan.blockedByUnseen);
}

}  // namespace
}  // namespace kinegraph
