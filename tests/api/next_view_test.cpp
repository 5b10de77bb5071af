#include "kinegraph/api/next_view.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"

namespace kinegraph {
namespace {

/// A camera that moves and turns in space, a hand beside it, and a table.
Config flyingCamera() {
  Config C;
  C.addText(R"g(
    table: { shape: box, size: [2, 2, .1], pose: [0, 0, -.05], contact: 1 }
    x(table): { joint: transX, limits: [-1, 1] }
    y(x): { joint: transY, limits: [-1, 1] }
    z(y): { joint: transZ, limits: [.2, 1.5], shape: sphere, size: [.04], contact: 1 }
    pan(z): { joint: hingeZ, limits: [-3.2, 3.2] }
    cam(pan): { pre: "d(180 1 0 0)", joint: hingeX, limits: [-2, 2], focalLength: 1., width: 320, height: 240 }
    fixed: { pose: [0, 0, 1], focalLength: 1., width: 320, height: 240 }
  )g");
  VectorXd q(5);
  q << -.6, 0., .5, 0., 0.;
  C.setJointState(q);
  return C;
}

/// Everything is free but an occupied block around the origin and what it hides behind it, seen along x.
OccupancyMap mapWithShadow(const Config& C) {
  OccupancyMap map(C, {-.8, -.6, 0.}, {.8, .6, .7}, .05);
  std::vector<CellState> states(map.states().size(), CellState::free);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Vector3d p = map.middle(i);
    if (std::abs(p.y()) > .15 || p.z() > .5 || p.x() < -.1) continue;
    if (p.x() < 0.)
      states[i] = CellState::occupied;
    else if (p.x() < .5)
      states[i] = CellState::hidden;
  }
  map.setStates(states);
  return map;
}

TEST(NextView, LooksBehindWhatHidesTheCells) {
  Config C = flyingCamera();
  const OccupancyMap map = mapWithShadow(C);
  map.attach(C, Unseen::shadows);
  VectorXd goal = C.getJointState();
  goal[0] = .3, goal[2] = .25;
  const MotionPlan plan = planMotion(C, MotionGoal(goal));
  ASSERT_TRUE(plan.blockedByUnseen) << plan.message;
  const NextView view = nextView(C, map, "cam", plan);
  ASSERT_TRUE(view.feasible()) << view.message;
  EXPECT_EQ(view.cells, int(plan.blockedByUnseen->cells.size()));
  EXPECT_GT(view.visible, view.cells / 2);
  int in_sight = 0;
  for (const Vector3d& cell : plan.blockedByUnseen->cells) {
    bool hidden = false;
    for (int i = 0; i <= 100; ++i) hidden |= map.state(cell + i / 100. * (view.pose.p - cell)) == CellState::occupied;
    in_sight += !hidden;
  }
  EXPECT_GE(in_sight, view.visible * .9);
  Config there = C;
  there.setJointState(view.q);
  EXPECT_LT((there.getFrame("cam").getPose().p - view.pose.p).norm(), 1e-9);
  EXPECT_TRUE(view.plan.eval(view.plan.duration()).q.isApprox(view.q, 1e-9));
}

TEST(NextView, RefusesWhatHasNoAnswer) {
  Config C = flyingCamera();
  const OccupancyMap map = mapWithShadow(C);
  map.attach(C, Unseen::shadows);
  VectorXd goal = C.getJointState();
  EXPECT_THROW(nextView(C, map, "cam", planMotion(C, MotionGoal(goal))), ValueError);
  goal[0] = .3, goal[2] = .25;
  const MotionPlan plan = planMotion(C, MotionGoal(goal));
  EXPECT_THROW(nextView(C, map, "fixed", plan), ValueError);
  EXPECT_THROW(nextView(C, map, "camm", plan), FrameNotFound);
  NextViewOptions options;
  options.nearest = 0.;
  EXPECT_THROW(nextView(C, map, "cam", plan, options), ValueError);
  options = {};
  options.nearest = options.farthest = 9.;
  const NextView none = nextView(C, map, "cam", plan, options);
  EXPECT_FALSE(none.feasible());
  EXPECT_FALSE(none.message.empty());
}

}  // namespace
}  // namespace kinegraph
