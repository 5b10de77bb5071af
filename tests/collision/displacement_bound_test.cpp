#include "kinegraph/collision/displacement_bound.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {
namespace {

State stateOf(const char* text) {
  Config scene;
  scene.addText(text);
  return scene.state();
}

VectorXd drawn(Rng& rng, Eigen::Index size, double scale) {
  VectorXd values(size);
  for (double& value : values) value = scale * rng.normal();
  return values;
}

/// A crane with revolute and prismatic joints about arbitrary axes, and a long hook.
Config slidingCrane() {
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

/// The summed speeds by the joints of points at the bounding radius of the hook.
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

TEST(DeviationBound, OfATwoLinkArmIsTheSumOfWhatItsJointsMoveItsTip) {
  const State arm = stateOf(R"(
base: {}
j1 (base): { joint: hingeZ }
j2 (j1): { joint: hingeZ, pre: [.5 0 0] }
tip (j2): { shape: sphere, size: [.1], Q: [.3 0 0], contact: 1 }
ball (base): { shape: sphere, size: [.1], X: [2 0 0], contact: 1 }
)");
  DeviationBound bound(arm);
  const VectorXd q = Eigen::Vector2d(.3, -.2);
  EXPECT_NEAR(bound.of(q, q, Eigen::Vector2d(.01, 0.)), .01 * .9, 1e-12);
  EXPECT_NEAR(bound.of(q, q, Eigen::Vector2d(.01, .02)), .01 * .9 + .02 * .4, 1e-12);
  EXPECT_EQ(bound.of(q, q, Eigen::Vector2d(0., 0.)), 0.);
}

TEST(DeviationBound, DistancesOfAllPairsDifferByNoMore) {
  const State scene = stateOf(R"(
base: {}
slide (base): { joint: transX }
j1 (slide): { joint: hingeZ, pre: [0 0 .2] }
l1 (j1): { shape: capsule, size: [.5 .03], Q: [.25 0 0 .7071068 0 .7071068 0], contact: 1 }
j2 (j1): { joint: hingeY, pre: [.5 0 0] }
out (j2): { joint: transX, pre: [.1 .1 0] }
hand (out): { shape: box, size: [.1 .2 .05], Q: [.3 0 0], contact: 1 }
left (out): { joint: hingeZ, pre: [.3 0 0], shape: sphere, size: [.05], Q: [0 .2 0], contact: 1 }
right (out): { joint: hingeZ, pre: [.3 0 0], mimic: left, shape: sphere, size: [.05], Q: [0 -.2 0], contact: 1 }
bird (base): { joint: free }
wing (bird): { shape: box, size: [.6 .1 .05], Q: [.2 0 0], contact: 1 }
wheel (base): { joint: circleZ, pre: [0 1 0] }
spoke (wheel): { shape: box, size: [.05 .6 .05], Q: [0 .3 0], contact: 1 }
wall (base): { shape: box, size: [1 .02 1], X: [0 .8 0], contact: 1 }
)");
  State here = scene, there = scene;
  DeviationBound bound(scene);
  Rng rng(4);
  double most = 0.;
  for (int i = 0; i < 400; ++i) {
    const VectorXd from = scene.q() + drawn(rng, scene.dofs(), .5), to = from + drawn(rng, scene.dofs(), .1);
    const VectorXd deviation = drawn(rng, scene.dofs(), i % 2 ? .05 : .005).cwiseAbs(),
                   largest = from.cwiseAbs().cwiseMax(to.cwiseAbs()) + deviation;
    bound.setLargest(largest);
    const double at_most = bound.of(from, to, deviation);
    const double share = rng.uniform();
    const VectorXd q = from + share * (to - from);
    VectorXd off = q;
    for (Eigen::Index dof = 0; dof < q.size(); ++dof) off[dof] += rng.uniform(-1., 1.) * deviation[dof];
    here.setJoints(q.data());
    there.setJoints(off.data());
    for (const auto& [a, b] : scene.model().movingPairs()) {
      const auto &body_a = *scene.model().body[std::size_t(a)], &body_b = *scene.model().body[std::size_t(b)];
      const double change = proximity(body_a, there.pose(a), body_b, there.pose(b)).distance -
                            proximity(body_a, here.pose(a), body_b, here.pose(b)).distance;
      EXPECT_LE(std::abs(change), at_most + 1e-9);
      most = std::max(most, std::abs(change) / at_most);
    }
  }
  EXPECT_GT(most, .3) << "and the bound is no wild one";
}

TEST(DisplacementBound, BoundsHowFarPointsMoveAtAllConfigurationsNearby) {
  const Config C = slidingCrane();
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
    const double bound = displacementBound(state, change, spread),
                 here = displacementBound(state, change, VectorXd::Zero(n));
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
  EXPECT_GT(highest, .85);            // the bound is tight
  EXPECT_GT(beyond_five_percent, 0);  // the value at one configuration plus 5 % is no bound
}

TEST(DisplacementBound, IsExactWhereOneJointMovesABall) {
  Config C;
  C.addText(
      "world: {}\narm(world): {joint: hingeZ}\nball(arm): {shape: sphere, size: [.1], Q: [.7, 0, 0], contact: 1}");
  const State state = C.state();
  EXPECT_NEAR(displacementBound(state, VectorXd{{.5}}, VectorXd{{3.}}), .5 * .8, 1e-12);
}

}  // namespace
}  // namespace kinegraph
