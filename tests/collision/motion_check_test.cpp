#include "kinegraph/collision/motion_check.h"

#include <gtest/gtest.h>

#include "kinegraph/common/text.h"
#include "kinegraph/scene/config.h"
#include "tests/support/two_arms.h"

using namespace kinegraph;

namespace {

constexpr double kTolerance = 1e-4;  ///< m

/// A ball that slides along x at the height of a wall that is 1 cm thin.
Config slider() {
  Config config;
  config.addText(R"g(
    world: {}
    ball(world): { joint: transX, shape: sphere, size: [.1], contact: 1 }
    wall: { X: "t(1 0 0)", shape: box, size: [.01 1 1], contact: 1 }
  )g");
  return config;
}

VectorXd numbers(std::initializer_list<double> values) {
  return Eigen::Map<const VectorXd>(values.begin(), Eigen::Index(values.size()));
}

/// Distances of the collidable pairs at q.
VectorXd distancesAt(const Config& config, const VectorXd& q) {
  State state = config.state();
  state.setJoints(q.data());
  const auto pairs = config.getCollidablePairs();
  VectorXd distances(Eigen::Index(pairs.size()));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto [a, b] = pairs[i];
    distances[Eigen::Index(i)] =
        proximity(*state.model().body[a], state.pose(a), *state.model().body[b], state.pose(b)).distance;
  }
  return distances;
}

}  // namespace

TEST(MotionChecker, FindsWhenABallMeetsAWall) {
  const Config config = slider();
  const auto contact = config.checkMotion(numbers({0.}), numbers({2.}), 0., kTolerance);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->time, .895 / 2., kTolerance / 2.);
  EXPECT_LE(contact->time, .895 / 2.) << "until then it is free";
  EXPECT_NEAR(contact->distance, .895 - 2. * contact->time, 1e-12);
  EXPECT_EQ(config.getFrame(contact->a).getName(), "ball");
  EXPECT_EQ(config.getFrame(contact->b).getName(), "wall");
  EXPECT_TRUE(config.checkMotion(numbers({2.}), numbers({0.})));
  EXPECT_FALSE(config.checkMotion(numbers({0.}), numbers({.89})));
}

TEST(MotionChecker, KeepsTheMargin) {
  const Config config = slider();
  EXPECT_FALSE(config.checkMotion(numbers({0.}), numbers({.79}), .1, kTolerance));
  const auto contact = config.checkMotion(numbers({0.}), numbers({1.}), .1, kTolerance);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->time, .795, kTolerance);
  const auto deep = config.checkMotion(numbers({0.}), numbers({1.}), -.05, kTolerance);
  ASSERT_TRUE(deep);
  EXPECT_NEAR(deep->time, .945, kTolerance);
}

TEST(MotionChecker, ReportsAContactAtTheStart) {
  const Config config = slider();
  const auto contact = config.checkMotion(numbers({.95}), numbers({0.}));
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->time, 0.);
  EXPECT_NEAR(contact->distance, -.055, 1e-12);
  EXPECT_TRUE(config.checkMotion(numbers({.95}), numbers({.95})));
  EXPECT_FALSE(config.checkMotion(numbers({.5}), numbers({.5})));
}

TEST(MotionChecker, PairsThatNoJointMovesApartDoNotCount) {
  Config config = slider();
  config.addFrame("rider", "ball", "Q: \"t(0 0 .151)\", joint: rigid, shape: sphere, size: [.05], contact: 1");
  const auto pairs = config.getCollidablePairs();
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_FALSE(config.checkMotion(numbers({0.}), numbers({.8})));
  EXPECT_FALSE(config.checkMotion(numbers({0.}), numbers({.8}), .002));
  config.addFrame("rest").setShape(ShapeType::sphere, {.3}).setPosition({1.2, 0, 0}).setContact(1);
  EXPECT_EQ(config.getCollisions().size(), 1u) << "the wall and what rests in it";
  EXPECT_FALSE(config.checkMotion(numbers({0.}), numbers({.79})));
  EXPECT_TRUE(config.checkMotion(numbers({0.}), numbers({.81})));
}

TEST(MotionChecker, AJointThatPassesItsLimitsEndsAMotion) {
  Config config = slider();
  config.addFrame("other", "world", "joint: transY, limits: [-1 1]");
  EXPECT_FALSE(config.checkMotion(numbers({0., 0.}), numbers({.5, 1. + 9e-6})));
  const auto contact = config.checkMotion(numbers({0., 0.}), numbers({.5, -2.}));
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->dof, 1);
  EXPECT_EQ(contact->time, .5);
  EXPECT_EQ(config.getFrame(contact->a).getName(), "other");
  const auto earlier = config.checkMotion(numbers({0., 0.}), numbers({2., -1.1}));
  ASSERT_TRUE(earlier);
  EXPECT_EQ(earlier->dof, -1) << "the wall is met before";
  const auto beyond = config.checkMotion(numbers({0., 1.5}), numbers({0., 0.}));
  ASSERT_TRUE(beyond);
  EXPECT_EQ(beyond->time, 0.);
  EXPECT_EQ(beyond->distance, -.5);
}

TEST(MotionChecker, AQuaternionThatPassesZeroIsNotCalledFree) {
  Config config;
  config.addText(
      "world: {}\n"
      "stick(world): { joint: quatBall, shape: capsule, size: [1 .1], contact: 1 } \n"
      "ball: { X: \"t(.5 0 0)\", shape: sphere, size: [.1], contact: 1 }");
  EXPECT_TRUE(config.checkMotion(numbers({1., 0., 0., 0.}), numbers({-1., 0., 0., 0.})));
  EXPECT_FALSE(config.checkMotion(numbers({1., 0., 0., 0.}), numbers({2., 0., 0., 0.}))) << "only the norm changes";
}

TEST(MotionChecker, AgreesWithManySamplesForEveryJointType) {
  constexpr int kSamples = 400;
  Rng rng(5);
  for (const Joints& joints : kTwoJoints) {
    Config config;
    config.addText(twoArms(joints.first, joints.second));
    MotionChecker checker(config.state());
    const int n = config.getJointDimension();
    int free = 0, hit = 0;
    for (int motion = 0; motion < 40; ++motion) {
      VectorXd from = config.model()->home, to = from;
      for (double& x : from) x += .6 * rng.normal();
      for (double& x : to) x += .6 * rng.normal();
      const double margin = motion % 2 == 0 ? 0. : .01;
      if (n == 0 || distancesAt(config, from).minCoeff() < margin + kTolerance) continue;
      const auto contact = checker.firstContact(from.data(), to.data(), margin, kTolerance);
      const double until = contact ? contact->time : 1.;
      for (int i = 0; i <= kSamples; ++i) {
        const double s = until * i / kSamples;
        EXPECT_GE(distancesAt(config, from + s * (to - from)).minCoeff(), margin - 1e-9)
            << joints.first << ", " << joints.second << " at " << s << " of " << until;
      }
      if (!contact) {
        ++free;
        continue;
      }
      ++hit;
      const double nearest = distancesAt(config, from + until * (to - from)).minCoeff();
      EXPECT_EQ(contact->distance, nearest) << joints.first;
      EXPECT_LT(nearest, margin + kTolerance) << joints.first;
    }
    EXPECT_GT(free, 2) << joints.first;
    EXPECT_GT(hit, 2) << joints.first;
  }
}

TEST(MotionChecker, AmongManyBodiesFindsTheSameContactsAsAmongFew) {
  Config few, many;
  few.addText(twoArms("joint: hingeZ", "joint: hinge, axis: [1 2 -1]"));
  many.addText(twoArms("joint: hingeZ", "joint: hinge, axis: [1 2 -1]"));
  for (int i = 0; i < 100; ++i)
    many.addText("far" + std::to_string(i) + ": { X: [" + std::to_string(10 + i) +
                 " 0 0], shape: sphere, size: [.3], contact: 1 }");
  MotionChecker checker(few.state()), among(many.state());
  Rng rng(6);
  int hit = 0;
  for (int motion = 0; motion < 60; ++motion) {
    VectorXd from = few.model()->home, to = from;
    for (double& x : from) x += .6 * rng.normal();
    for (double& x : to) x += .6 * rng.normal();
    const auto expected = checker.firstContact(from.data(), to.data(), 0., kTolerance),
               found = among.firstContact(from.data(), to.data(), 0., kTolerance);
    ASSERT_EQ(found.has_value(), expected.has_value());
    if (!found) continue;
    ++hit;
    EXPECT_LT(found->distance,
              kTolerance);  // long edges are cut into pieces, and the contact may differ within the tolerance
    EXPECT_NEAR(found->time, expected->time, 1e-2);
    const VectorXd change = to - from, before = from + (expected->time - .02) * change,
                   behind = from + (expected->time + .02) * change;
    const auto near_few = checker.firstContact(before.data(), behind.data(), 0., kTolerance);
    const auto near_many = among.firstContact(before.data(), behind.data(), 0., kTolerance);
    ASSERT_TRUE(near_few && near_many);
    EXPECT_EQ(near_many->time, near_few->time) << "in one piece it is the same search";
    EXPECT_EQ(near_many->distance, near_few->distance);
  }
  EXPECT_GT(hit, 10);
}

TEST(MotionChecker, AmongManyBodiesThatMoveAgreesWithManySamples) {
  Config config;  // balls on a lattice, and boxes between them that fly about
  std::string text = "world: {}\n";
  for (int i = 0; i < 80; ++i)
    text += cat("ball", i, ": { X: [", .5 * (i % 5), " ", .5 * (i / 5 % 4), " ", .5 * (i / 20),
                "], shape: sphere, size: [.08], contact: 1 }\n");
  for (int i = 0; i < 12; ++i) {
    text += cat("box", i, "(world): { pre: [", .25 + .5 * (i % 4), " ", .25 + .5 * (i / 4),
                " .25], joint: ", i % 2 ? "free" : "trans3", ", shape: ssBox, size: [.2 .1 .15 .02], contact: 1 }\n");
  }
  config.addText(text);
  const VectorXd home = config.model()->home;
  MotionChecker checker(config.state());
  State state = config.state();
  PairDistances pairs(config.model());
  const auto nearestAt = [&](const VectorXd& q) {
    state.setJoints(q.data());
    double nearest = 1e9;
    pairs.forAll(state, [&](int, const Proximity& near) { nearest = std::min(nearest, near.distance); });
    return nearest;
  };
  Rng rng(9);
  int free = 0, hit = 0;
  for (int motion = 0; motion < 12; ++motion) {
    VectorXd from = home, to = home;
    for (double& x : from) x += .02 * rng.normal();
    for (double& x : to) x += .1 * rng.normal();
    const double start = nearestAt(from);
    double least = start;
    for (int i = 0; i <= 40; ++i) least = std::min(least, nearestAt(from + i / 40. * (to - from)));
    for (const double margin : {least - .02, .5 * (least + start)}) {
      const auto contact = checker.firstContact(from.data(), to.data(), margin, 1e-3);
      ASSERT_TRUE(contact || least >= margin) << motion;
      if (!contact) {
        ++free;
        continue;
      }
      ++hit;
      EXPECT_LT(contact->distance, margin + 1e-3) << motion;
      EXPECT_GE(nearestAt(from + .5 * contact->time * (to - from)), margin) << motion;
      nearestAt(from + contact->time * (to - from));
      const double there = proximity(*state.model().body[std::size_t(contact->a)], state.pose(contact->a),
                                     *state.model().body[std::size_t(contact->b)], state.pose(contact->b))
                               .distance;
      EXPECT_NEAR(there, contact->distance, 1e-12) << motion;
    }
  }
  EXPECT_GT(free, 3);
  EXPECT_GT(hit, 3);
}

TEST(MotionChecker, AmongManyBodiesFollowsThoseThatAreMovedByHand) {
  Config config = slider();
  for (int i = 0; i < 100; ++i)
    config.addText("rest" + std::to_string(i) + ": { X: [" + std::to_string(10 + i) +
                   " 0 0], shape: sphere, size: [.3], contact: 1 }");
  const auto blocked = [&] { return config.checkMotion(numbers({0.}), numbers({.5})).has_value(); };
  EXPECT_FALSE(blocked());
  config.getFrame("rest3").setPosition({.5, 0, 0});
  EXPECT_TRUE(blocked());
  config.getFrame("rest3").setPosition({13., 0, 0});
  EXPECT_FALSE(blocked());
  config.addFrame("more").setShape(ShapeType::sphere, {.3}).setPosition({.5, 0, 0}).setContact(1);
  EXPECT_TRUE(blocked());
}

TEST(MotionChecker, AmongManyBodiesThoseThatRestDoNotCount) {
  Config config = slider();
  for (int i = 0; i < 100; ++i)
    config.addText("rest" + std::to_string(i) + ": { X: [" + std::to_string(10 + i) +
                   " 0 0], shape: sphere, size: [.3], contact: 1 }");
  EXPECT_FALSE(config.checkMotion(numbers({0.}), numbers({.5})));
  config.getFrame("rest7").setPosition({10.1, 0, 0});
  EXPECT_EQ(config.getCollisions().size(), 1u);
  EXPECT_FALSE(config.checkMotion(numbers({0.}), numbers({.5})));
}

TEST(MotionChecker, ABladeThatTurnsPastAThinPostIsNeverLetThrough) {
  Config config;
  config.addText(R"g(
    world: {}
    arm(world): { joint: hingeZ }
    blade(arm): { Q: "t(.5 0 0)", shape: box, size: [1 .001 .001], contact: 1 }
    post: { X: "t(0 .9 0)", shape: cylinder, size: [.01 .0005], contact: 1 }
  )g");
  const double quarter = 2. * std::atan(1.);
  for (const double to : {1.8, 3., 6., -5., 100.}) {
    const auto contact = config.checkMotion(numbers({.2}), numbers({to}));
    ASSERT_TRUE(contact) << to;
    const double angle = .2 + contact->time * (to - .2),
                 turned = std::abs(std::remainder(angle - quarter, 4. * quarter));
    EXPECT_LT(turned, .01) << to;
  }
  EXPECT_FALSE(config.checkMotion(numbers({.2}), numbers({1.56})));
}
