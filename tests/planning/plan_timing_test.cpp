#include "kinegraph/planning/plan_timing.h"
#include "kinegraph/collision/travel_bound.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"

namespace kinegraph {
namespace {

/// A crane with hinges and slides whose axes point anywhere, and a long hook.
Config crane() {
  Config C;
  C.addText(R"(
world: {}
rail(world): {joint: transX, Q: [0, 0, 0.5, 0.9, 0.1, 0.3, 0.2]}
arm(rail): {joint: hingeY, Q: [0, 0, 0.6]}
boom(arm): {joint: hingeZ, pre: [0.4, 0, 0, 0.7, 0, 0.7, 0]}
slide(boom): {joint: transZ, pre: [0.1, 0.2, 0, 0.8, 0.2, 0, 0.1]}
wrist(slide): {joint: hingeX, pre: [0, 0.3, 0]}
hook(wrist): {shape: capsule, size: [0.4, 0.03], Q: [0.2, 0, -0.1], contact: 1}
)");
  return C;
}

/// How fast the joints move points of the hook that are as far from its middle as its bound is large, in sum.
double speedOf(const State& state, int hook, const VectorXd& change) {
  const auto& body = state.model().body[std::size_t(hook)];
  const Vector3d center = state.pose(hook) * body->boundCenter();
  double most = 0.;
  for (int axis = 0; axis < 6; ++axis) {
    const Vector3d point = center + body->boundRadius() * (axis % 2 ? -1. : 1.) * Vector3d::Unit(axis / 2);
    double sum = 0.;
    state.forTwists(hook, [&](int dof, const State::Twist& twist) {
      sum += change[dof] * (twist.linear + twist.angular.cross(point)).norm();
    });
    most = std::max(most, sum);
  }
  return most;
}

}  // namespace

TEST(TravelOf, BoundsHowFarPointsMoveAtAllPosturesNearby) {
  const Config C = crane();
  State state = C.state(), there = C.state();
  const int n = state.dofs(), hook = C.getFrame("hook").id();
  Rng rng(5);
  double highest = 0.;
  int beyond_five_percent = 0;
  for (int i = 0; i < 400; ++i) {
    VectorXd q(n), spread(n), change(n), near(n);
    for (int j = 0; j < n; ++j) {
      q[j] = rng.uniform(-2., 2.), spread[j] = rng.uniform(0., .4), change[j] = rng.uniform(0., .1);
    }
    state.setJoints(q.data());
    const double bound = travelOf(state, change, spread), here = travelOf(state, change, VectorXd::Zero(n));
    EXPECT_LE(here, bound);
    for (int k = 0; k < 60; ++k) {
      for (int j = 0; j < n; ++j)
        near[j] = q[j] + spread[j] * (k < 30 ? (rng.uniform(0., 1.) < .5 ? -1. : 1.) : rng.uniform(-1., 1.));
      there.setJoints(near.data());
      const double speed = speedOf(there, hook, change);
      EXPECT_LE(speed, bound * (1. + 1e-12));
      highest = std::max(highest, speed / bound);
      beyond_five_percent += speed > 1.05 * here;
    }
  }
  EXPECT_GT(highest, .85);            // it is not far off
  EXPECT_GT(beyond_five_percent, 0);  // what stands at one posture alone, and a little more, is no bound
}

TEST(TravelOf, IsExactWhereOneJointMovesABall) {
  Config C;
  C.addText(
      "world: {}\narm(world): {joint: hingeZ}\nball(arm): {shape: sphere, size: [.1], Q: [.7, 0, 0], contact: 1}");
  const State state = C.state();
  EXPECT_NEAR(travelOf(state, VectorXd{{.5}}, VectorXd{{3.}}), .5 * .8, 1e-12);
}

}  // namespace kinegraph
