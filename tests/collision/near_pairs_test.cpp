#include "kinegraph/collision/near_pairs.h"

#include <gtest/gtest.h>

#include "kinegraph/scene/config.h"

using namespace kinegraph;

namespace {

/// A body of each kind on a chain, and a wide table.
Config chain() {
  Config config;
  config.addText(R"g(
    table: { X: "t(0 0 .1)", shape: ssBox, size: [2 2 .1 .02], contact: 1 }
    one(table): { pre: "t(.1 0 .4)", joint: hingeZ, shape: capsule, size: [.3 .05], contact: 1 }
    two(one): { pre: "t(.3 0 .1)", joint: hingeY, shape: ssBox, size: [.3 .1 .2 .02], contact: 1 }
    three(two): { pre: "t(.2 .1 .1)", joint: hingeX, shape: cylinder, size: [.2 .05], contact: 1 }
    four(three): { pre: "t(.2 0 .1)", joint: trans3, shape: sphere, size: [.08], contact: 1 }
    five(four): { Q: "t(.1 .1 .1)", shape: ssCylinder, size: [.2 .08 .02], contact: 1 }
    marker(four): { shape: marker, size: [.1] }
  )g");
  return config;
}

}  // namespace

TEST(BodyPairs, HaveEachFrameOnce) {
  const Config config = chain();
  const int marker = config.getFrame("marker").id();
  const BodyPairs pairs(*config.model(), {{0, 2}, {1, 2}, {0, marker}});
  EXPECT_EQ(pairs.frames, (std::vector<int>{0, 2, 1, marker}));
  EXPECT_EQ(pairs.pairs, (std::vector<std::pair<int, int>>{{0, 1}, {2, 1}, {0, 3}}));
  EXPECT_EQ(pairs.bodies[3]->core(), CollisionBody::Core::point) << "a frame that cannot collide counts as a point";
}

TEST(PlacedBodies, NeverDenyAPairWithinTheMarginAndDenyMostOfTheOthers) {
  Config config = chain();
  const BodyPairs pairs(*config.model(), config.getCollidablePairs());
  ASSERT_GT(pairs.pairs.size(), 10u);
  PlacedBodies bodies(pairs);
  Rng rng(4);
  int near = 0, far = 0, denied = 0;
  for (int sample = 0; sample < 200; ++sample) {
    State state = config.state();
    VectorXd q(state.dofs());
    for (double& x : q) x = .8 * rng.normal();
    state.setJoints(q.data());
    for (const double margin : {-.05, 0., .1}) {
      bodies.place(state);
      for (int pair = 0; pair < bodies.pairs(); ++pair) {
        const bool may = bodies.mayBeNear(pair, margin);
        const auto [a, b] = config.getCollidablePairs()[pair];
        const Proximity exact = proximity(*state.model().body[a], state.pose(a), *state.model().body[b], state.pose(b));
        EXPECT_EQ(bodies.proximity(pair).distance, exact.distance);
        if (exact.distance <= margin) {
          EXPECT_TRUE(may) << a << ", " << b << " at " << exact.distance << ", margin " << margin;
          ++near;
        } else {
          ++far;
          denied += !may;
        }
      }
    }
  }
  EXPECT_GT(near, 300);
  EXPECT_GT(denied, .8 * far);
}
