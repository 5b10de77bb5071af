#include "kinegraph/kinematics/placed_samples.h"

#include <gtest/gtest.h>

#include "kinegraph/base/random.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/math/lane_widths.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {
namespace {

/// Joints of many types, bodies of many kinds, turned any way.
Config crane() {
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
)");
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
  State state = C.state();
  const LinkBodies bodies(state);
  PlacedSamples samples(state, bodies, sampleKernel(GetParam()));
  const std::vector<VectorXd> Q = draws(state, 8);
  for (int i = 0; i < 8; ++i) samples.setJoints(i, Q[std::size_t(i)].data());
  samples.place(8);
  int told = 0;
  for (const LinkBodies::Pair& pair : bodies.pairs) {
    const PlacedSamples::Lane bounds = samples.distanceBounds(pair.a, pair.b);
    for (int i = 0; i < 8; ++i) {
      const LinkBodies::Body &a = bodies.bodies[std::size_t(pair.a)], &b = bodies.bodies[std::size_t(pair.b)];
      EXPECT_LE(bounds[i],
                proximity(*a.shape, samples.pose(pair.a, i), *b.shape, samples.pose(pair.b, i)).distance + 1e-12);
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

TEST_P(InLanes, AllWidthsGiveTheSameBits) {
  const Config C = crane();
  const State state = C.state();
  const LinkBodies bodies(state);
  PlacedSamples samples(state, bodies, sampleKernel(GetParam())), narrow(state, bodies, sampleKernel(2));
  const std::vector<VectorXd> Q = draws(state, 8);
  for (PlacedSamples* each : {&samples, &narrow}) {
    for (int i = 0; i < 8; ++i) each->setJoints(i, Q[std::size_t(i)].data());
    each->place(8);
  }
  for (const LinkBodies::Pair& pair : bodies.pairs)
    EXPECT_TRUE((samples.distanceBounds(pair.a, pair.b) == narrow.distanceBounds(pair.a, pair.b)).all());
  for (int b = 0; b < int(bodies.bodies.size()); ++b)
    for (int i = 0; i < 8; ++i) EXPECT_EQ(samples.pose(b, i).p, narrow.pose(b, i).p);
}

INSTANTIATE_TEST_SUITE_P(Widths, InLanes, ::testing::ValuesIn(laneWidths()));

}  // namespace
}  // namespace kinegraph
