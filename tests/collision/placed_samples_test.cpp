#include "kinegraph/collision/placed_samples.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/math/lane_widths.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {
namespace {

/// Joints of many types and bodies of many kinds, at random orientations.
Config crane(const std::string& more = "") {
  Config C;
  C.addText(R"(
world: {}
rail(world): {joint: transX, limits: [-1, 1], Q: [0, 0, 0.5, 0.9, 0.1, 0.3, 0.2]}
post(rail): {shape: ssBox, size: [0.1, 0.2, 0.6, 0.02], Q: [0, 0, 0.3, 0.8, 0.2, 0.1, 0.4], contact: 1}
arm(rail): {joint: hingeY, limits: [-2, 2], Q: [0, 0, 0.6]}
boom(arm): {shape: capsule, size: [0.8, 0.05], Q: [0.4, 0, 0, 0.7, 0, 0.7, 0], contact: 1}
wrist(arm): {joint: quatBall, Q: [0.8, 0, 0]}
hook(wrist): {shape: sphere, size: [0.06], Q: [0, 0, -0.1], contact: 1}
plate(wrist): {shape: box, size: [0.2, 0.1, 0.02], Q: [0.1, 0, -0.2], contact: 1}
crate(world): {shape: box, size: [0.4, 0.4, 0.4], Q: [0.9, 0.2, 0.2, 0.9, 0, 0, 0.3], contact: 1}
)" + more);
  return C;
}

std::vector<VectorXd> draws(const State& scene, int count) {
  Rng rng(1);
  std::vector<VectorXd> Q;
  for (int i = 0; i < count; ++i) {
    VectorXd q(scene.dofs());
    for (double& value : q) value = rng.uniform(-1., 1.);
    q.tail(4).normalize();
    Q.push_back(q);
  }
  return Q;
}

/// Eight configurations.
void placeDraws(PlacedSamples& samples, const State& scene) {
  const std::vector<VectorXd> Q = draws(scene, 8);
  for (int i = 0; i < 8; ++i) samples.setJoints(i, Q[std::size_t(i)].data());
  samples.place(8);
}

class InLanes : public ::testing::TestWithParam<int> {};

TEST_P(InLanes, LinksAndBodiesAreWhereAStatePutsThem) {
  const Config C = crane();
  State state = C.state();
  const LinkBodies bodies(state);
  PlacedSamples samples(state, bodies, sampleKernel(GetParam()));
  for (const int count : {1, 3, 8, 5}) {
    const std::vector<VectorXd> Q = draws(state, count);
    for (int i = 0; i < count; ++i) samples.setJoints(i, Q[std::size_t(i)].data());
    samples.place(count);
    for (int i = 0; i < count; ++i) {
      state.setJoints(Q[std::size_t(i)].data());
      for (int b = 0; b < int(bodies.bodies.size()); ++b) {
        const RigidTransform wanted = state.pose(bodies.bodies[std::size_t(b)].frame), X = samples.pose(b, i);
        EXPECT_LT((X.R - wanted.R).norm() + (X.p - wanted.p).norm(), 1e-14);
        const RigidTransform link = samples.linkPose(bodies.link(b), i);
        EXPECT_LT((link.p - state.linkPose(bodies.link(b)).p).norm(), 1e-14);
      }
    }
  }
}

TEST_P(InLanes, BoundsAreBelowDistancesAndSpheresAroundBodies) {
  const Config C = crane();
  const State state = C.state();
  const LinkBodies bodies(state);
  PlacedSamples samples(state, bodies, sampleKernel(GetParam()));
  placeDraws(samples, state);
  int told = 0;
  for (const LinkBodies::Pair& pair : bodies.pairs) {
    const auto [bounds, tops] = samples.distanceBounds(pair.a, pair.b);
    for (int i = 0; i < 8; ++i) {
      const LinkBodies::Body &a = bodies.bodies[std::size_t(pair.a)], &b = bodies.bodies[std::size_t(pair.b)];
      const double distance = proximity(*a.shape, samples.pose(pair.a, i), *b.shape, samples.pose(pair.b, i)).distance;
      EXPECT_LE(bounds[i], distance + 1e-12);
      EXPECT_GE(tops[i], distance - 1e-12);
      told += bounds[i] > 0.;
      for (const int body : {pair.a, pair.b}) {
        const PlacedSamples::Sphere& sphere = samples.sphere(bodies.bodies[std::size_t(body)].group);
        const CollisionBody& shape = *bodies.bodies[std::size_t(body)].shape;
        EXPECT_LE((samples.pose(body, i) * shape.boundCenter() - sphere.center).norm() + shape.boundRadius(),
                  sphere.radius + 1e-12);
      }
    }
  }
  EXPECT_GT(told, 20);
}

/// Also hulls of few and of many corners, and round bodies.
Config craneAmongHulls() {
  Config C = crane(R"(
drum(arm): {shape: cylinder, size: [0.3, 0.1], Q: [0.2, 0.1, 0.2, 0.8, 0.1, 0.2, 0.3], contact: 1}
pad(world): {shape: ssBoxElip, size: [0.2, 0.1, 0.1, 0.05, 0.1, 0.07, 0.02], Q: [0.4, 0.9, 0.2, 0.8, 0.3, 0, 0], contact: 1}
)");
  Rng rng(3);
  for (const auto& [name, parent, corners] :
       {std::tuple("pebble", "wrist", 7), {"rock", "wrist", 200}, {"stone", "arm", 30}, {"boulder", "world", 150}}) {
    std::vector<Vector3d> points;
    for (int i = 0; i < corners; ++i)
      points.push_back(.2 * Vector3d(rng.normal(), rng.normal(), rng.normal()).normalized());
    C.addFrame(name, parent).setRelativePosition({.3, .2, .1}).setConvexCore(points, .01).setContact(1);
  }
  return C;
}

TEST_P(InLanes, GapsAreFromTheFarthestPointOfOneToThatOfTheOther) {
  const Config C = craneAmongHulls();
  const State state = C.state();
  const LinkBodies bodies(state);
  PlacedSamples samples(state, bodies, sampleKernel(GetParam()));
  placeDraws(samples, state);
  Rng rng(2);
  ASSERT_GT(bodies.pairs.size(), 20u);
  for (const LinkBodies::Pair& pair : bodies.pairs) {
    const CollisionBody &a = *bodies.bodies[std::size_t(pair.a)].shape, &b = *bodies.bodies[std::size_t(pair.b)].shape;
    SupportCorners corners;
    for (const int link : {0, bodies.link(pair.a)}) {
      const Vector3d n = Vector3d(rng.normal(), rng.normal(), rng.normal()).normalized();
      const PlacedSamples::Lane gaps = samples.gaps(pair.a, pair.b, n, link, corners);
      for (int i = 0; i < 8; ++i) {
        const Vector3d world = samples.linkPose(link, i).R * n;
        const RigidTransform X_A = samples.pose(pair.a, i), X_B = samples.pose(pair.b, i);
        const Vector3d least = X_A * a.support(-(X_A.R.transpose() * world)),
                       most = X_B * b.support(X_B.R.transpose() * world);
        EXPECT_NEAR(gaps[i], world.dot(least - most) - a.radius() - b.radius(), 1e-12);
        EXPECT_LE(gaps[i], proximity(a, X_A, b, X_B).distance + 1e-9);
      }
    }
  }
}

TEST_P(InLanes, WhatDoesNotMoveIsNearAGroupAllAtOnce) {
  const Config C = craneAmongHulls();
  const State state = C.state();
  const LinkBodies bodies(state);
  PlacedSamples samples(state, bodies, sampleKernel(GetParam()));
  Rng rng(4);
  int near = 0, far = 0;
  for (int draw = 0; draw < 20; ++draw) {
    const std::vector<VectorXd> Q = draws(state, 1);
    samples.setJoints(0, VectorXd(Q[0] * rng.uniform(.5, 2.)).data());
    samples.place(1);
    for (int g = 0; g < bodies.moving; ++g) {
      for (const double margin : {0., .3, -.1, -10.}) {
        const std::vector<std::int64_t>& found = samples.nearFixed(g, margin);
        for (int other = bodies.moving; other < int(bodies.groups.size()); ++other) {
          const bool is_near = found[std::size_t(other - bodies.moving)] != 0;
          EXPECT_EQ(is_near, samples.mayBeNear(g, other, margin));
          is_near ? ++near : ++far;
        }
      }
    }
  }
  EXPECT_GT(near, 20);
  EXPECT_GT(far, 20);
}

TEST_P(InLanes, AllWidthsGiveTheSameBits) {
  const Config C = craneAmongHulls();
  const State state = C.state();
  const LinkBodies bodies(state);
  PlacedSamples samples(state, bodies, sampleKernel(GetParam())), narrow(state, bodies, sampleKernel(2));
  for (PlacedSamples* each : {&samples, &narrow}) placeDraws(*each, state);
  for (const LinkBodies::Pair& pair : bodies.pairs) {
    const auto [least, most] = samples.distanceBounds(pair.a, pair.b);
    const auto [narrow_least, narrow_most] = narrow.distanceBounds(pair.a, pair.b);
    EXPECT_TRUE((least == narrow_least).all() && (most == narrow_most).all());
    SupportCorners corners, narrow_corners;
    const Vector3d n = Vector3d(.3, -.5, .8).normalized();
    EXPECT_TRUE((samples.gaps(pair.a, pair.b, n, pair.ancestor, corners) ==
                 narrow.gaps(pair.a, pair.b, n, pair.ancestor, narrow_corners))
                    .all());
  }
  for (int b = 0; b < int(bodies.bodies.size()); ++b)
    for (int i = 0; i < 8; ++i) EXPECT_EQ(samples.pose(b, i).p, narrow.pose(b, i).p);
}

INSTANTIATE_TEST_SUITE_P(Widths, InLanes, ::testing::ValuesIn(laneWidths()));

}  // namespace
}  // namespace kinegraph
