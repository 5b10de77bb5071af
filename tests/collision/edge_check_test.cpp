#include "kinegraph/collision/edge_check.h"

#include <gtest/gtest.h>

#include "kinegraph/collision/motion_check.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/scene/config.h"
#include "tests/support/two_arms.h"

using namespace kinegraph;

namespace {

constexpr double kEdgeTolerance = 1e-5;  ///< m

/// Two arms, one with an attached object, and obstacles of all kinds.
std::string scene(const std::string& first, const std::string& second) {
  return twoArms(first, second) +
         "held(finger): { Q: \"t(.05 .02 .1) d(35 1 .6 .2)\", shape: cylinder, size: [.1 .03], contact: 1 }\n"
         "wall: { X: \"t(-.3 0 .2) d(20 1 1 0)\", shape: box, size: [.02 .5 .5], contact: 1 }\n"
         "points: { X: \"t(.1 -.4 .1)\", shape: pointCloud, vertices: [0 0 0 .05 0 0 .1 .02 .1 0 .1 .1], contact: 1 "
         "}\n";
}

/// The least distance of the pairs that count.
class Nearest {
 public:
  explicit Nearest(const Config& config) : state_(config.state()), pairs_(config.model()->movingPairs()) {}

  double at(const VectorXd& q) {
    state_.setJoints(q.data());
    double nearest = 1e9;
    for (const auto& [a, b] : pairs_) nearest = std::min(nearest, ofPair(a, b));
    return nearest;
  }
  double ofPair(int a, int b) const {
    return proximity(*state_.model().body[std::size_t(a)], state_.pose(a), *state_.model().body[std::size_t(b)],
                     state_.pose(b))
        .distance;
  }

 private:
  State state_;
  std::vector<std::pair<int, int>> pairs_;
};

struct Motion {
  VectorXd from, to;
};

Motion draw(const Config& config, Rng& rng, double step) {
  VectorXd from = config.model()->home, to = from;
  for (double& x : from) x += .6 * rng.normal();
  to = from;
  for (double& x : to) x += step * rng.normal();
  return {from, to};
}

Config withFarBalls(Config config, int count) {
  for (int i = 0; i < count; ++i)
    config.addText(cat("far", i, ": { X: [", 10 + i, " 0 0], shape: sphere, size: [.3], contact: 1 }"));
  return config;
}

}  // namespace

TEST(EdgeChecker, AgreesWithTheMotionCheckerForEveryJointType) {
  Rng rng(5);
  for (const Joints& joints : kTwoJoints) {
    Config config;
    config.addText(scene(joints.first, joints.second));
    const Config many = withFarBalls(config, 80);
    Nearest nearest(config);
    int free = 0, hit = 0;
    for (const double margin : {0., .01, -.01}) {
      EdgeChecker checker(config.state(), margin, kEdgeTolerance), among(many.state(), margin, kEdgeTolerance);
      MotionChecker strict(config.state());
      for (int i = 0; i < 60; ++i) {
        const auto [from, to] = draw(config, rng, i % 3 == 0 ? .6 : .1);
        const bool is_free = checker.isFree(from.data(), to.data());
        EXPECT_EQ(among.isFree(from.data(), to.data()), is_free) << joints.first;
        (is_free ? free : hit) += 1;
        if (is_free) {
          EXPECT_FALSE(strict.firstContact(from.data(), to.data(), margin - 1e-9, 1e-10))
              << joints.first << ", " << joints.second;
        } else {
          ASSERT_TRUE(checker.lastHit());
          const MotionContact& contact = *checker.lastHit();
          const double there = nearest.at(from + contact.time * (to - from));
          EXPECT_LT(contact.distance, margin + kEdgeTolerance) << joints.first;
          EXPECT_LT(there, margin + kEdgeTolerance) << joints.first;
          EXPECT_NEAR(nearest.ofPair(contact.a, contact.b), contact.distance, 1e-9) << joints.first;
        }
      }
    }
    EXPECT_GT(free, 10) << joints.first;
    EXPECT_GT(hit, 10) << joints.first;
  }
}

TEST(EdgeChecker, WhatIsFreeIsFreeInManySamples) {
  constexpr int kSamples = 300;
  Rng rng(6);
  for (const Joints& joints : kTwoJoints) {
    Config config;
    config.addText(scene(joints.first, joints.second));
    Nearest nearest(config);
    EdgeChecker checker(config.state());
    for (int i = 0; i < 40; ++i) {
      const auto [from, to] = draw(config, rng, .2);
      const double least = checker.clearance(from.data(), to.data(), .5);
      double sampled = .5;
      for (int k = 0; k <= kSamples; ++k)
        sampled = std::min(sampled, nearest.at(from + double(k) / kSamples * (to - from)));
      EXPECT_LE(least, sampled) << joints.first << ", " << joints.second;
      EXPECT_GT(least, sampled - .01) << joints.first << ", " << joints.second;
      checker.setMargin(least - 2. * kEdgeTolerance);
      EXPECT_TRUE(checker.isFree(from.data(), to.data())) << joints.first;
      checker.setMargin(sampled + 1e-9);
      EXPECT_FALSE(checker.isFree(from.data(), to.data())) << joints.first;
    }
  }
}

TEST(EdgeChecker, ConfigurationsAreFreeWhereAllPairsKeepTheMargin) {
  Config config;
  config.addText(scene("joint: hingeZ", "joint: free"));
  Nearest nearest(config);
  Rng rng(7);
  for (const double margin : {0., .02, -.02}) {
    EdgeChecker checker(config.state(), margin), alone(config.state(), margin);
    for (int i = 0; i < 40; ++i) {
      const auto [from, to] = draw(config, rng, .1);
      std::vector<VectorXd> Q;
      std::vector<const double*> rows;
      for (int k = 0; k < EdgeChecker::kLanes - i % 3; ++k) Q.push_back(from + .1 * k * (to - from));
      for (const VectorXd& q : Q) rows.push_back(q.data());
      bool free[EdgeChecker::kLanes];
      checker.areFree(rows, free);
      for (std::size_t k = 0; k < Q.size(); ++k) {
        EXPECT_EQ(free[k], nearest.at(Q[k]) >= margin);
        EXPECT_EQ(alone.isFree(Q[k].data()), free[k]);
        EXPECT_NEAR(alone.clearance(Q[k].data()), nearest.at(Q[k]), 1e-12);
        EXPECT_EQ(alone.clearance(Q[k].data(), -.5), -.5);
      }
    }
  }
}

TEST(EdgeChecker, AnswersDoNotDependOnWhatWasAskedBefore) {
  Config config;
  config.addText(scene("joint: hingeZ", "joint: hinge, axis: [1 2 -1]"));
  Rng rng(8);
  EdgeChecker long_asked(config.state(), .01);
  for (int i = 0; i < 200; ++i) {
    const auto [from, to] = draw(config, rng, .3);
    EdgeChecker fresh(config.state(), .01);
    ASSERT_EQ(long_asked.isFree(from.data()), fresh.isFree(from.data()));
    ASSERT_EQ(long_asked.isFree(from.data(), to.data()), fresh.isFree(from.data(), to.data()));
    ASSERT_EQ(long_asked.clearance(from.data(), to.data(), 1.), fresh.clearance(from.data(), to.data(), 1.));
  }
}

TEST(EdgeChecker, ABladeThatTurnsPastAThinPostIsNeverLetThrough) {
  Config config;
  config.addText(R"g(
    world: {}
    arm(world): { joint: hingeZ }
    blade(arm): { Q: "t(.5 0 0)", shape: box, size: [1 .001 .001], contact: 1 }
    post: { X: "t(0 .9 0)", shape: cylinder, size: [.01 .0005], contact: 1 }
  )g");
  EdgeChecker checker(config.state());
  for (const double to : {1.8, 3., 6., -5., 100.}) {
    const double from = .2;
    EXPECT_FALSE(checker.isFree(&from, &to)) << to;
  }
  const double from = .2, before = 1.56, zero = 0.;
  EXPECT_TRUE(checker.isFree(&from, &before));
  EXPECT_TRUE(checker.isFree(&zero, &zero));
}

TEST(EdgeChecker, SlidesAlongASurfaceThatItTouchesAlmost) {
  Config config;
  config.addText(R"g(
    world: {}
    block(world): { joint: transXY, shape: box, size: [.1 .1 .1], contact: 1 }
    table: { X: "t(0 0 -.06)", shape: box, size: [2 2 .02], contact: 1 }
    ledge: { X: "t(0 .2 .2)", shape: ssBox, size: [2 .05 .05 .01], contact: 1 }
  )g");
  const VectorXd from = VectorXd::Constant(2, -.5), to = VectorXd::Constant(2, .5);
  for (const double gap : {-1e-6, 2e-6, 2e-5}) {
    config.getFrame("table").setPosition({0., 0., -.06 - gap});
    EdgeChecker checker(config.state());
    EXPECT_EQ(checker.isFree(from.data(), to.data()), gap > 0.) << gap;
    EXPECT_NEAR(checker.clearance(from.data(), to.data(), 1.), gap - kEdgeTolerance, 1e-12) << gap;
  }
}

TEST(EdgeChecker, FindsWherePairsComeNearestOnTheWay) {
  constexpr int kFine = 400;
  constexpr double kMost = .08, kNearEnough = 2e-3;  // m
  Config config;
  config.addText(scene("joint: hingeX", "joint: hingeY"));
  EdgeChecker checker(config.state());
  Nearest nearest(config);
  Rng rng(3);
  int found = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto [from, to] = draw(config, rng, .2);
    const auto q = [&](double s) -> VectorXd { return (1. - s) * from + s * to; };
    const auto distanceOf = [&](const MotionContact& pair, double s) {
      nearest.at(q(s));
      return nearest.ofPair(pair.a, pair.b);
    };
    double least_found = kMost;
    for (const MotionContact& approach : checker.approaches(from.data(), to.data(), kMost)) {
      const auto [time, a, b, distance, dof] = approach;
      EXPECT_TRUE(time > 0. && time < 1. && a < b && distance < kMost);
      EXPECT_NEAR(distanceOf(approach, time), distance, 1e-9);
      for (const double step : {-.15, .15})
        if (time + step > 0. && time + step < 1.) EXPECT_GT(distanceOf(approach, time + step), distance - kNearEnough);
      least_found = std::min(least_found, distance);
    }
    double inside = kMost, ends = std::min({kMost, nearest.at(from), nearest.at(to)});
    for (int i = 1; i < kFine; ++i) inside = std::min(inside, nearest.at(q(double(i) / kFine)));
    if (inside > ends - kNearEnough) continue;  // the minimum is at an end
    EXPECT_LT(least_found, inside + kNearEnough) << trial;
    ++found;
  }
  EXPECT_GT(found, 10);
}

TEST(EdgeChecker, AQuaternionThatPassesZeroIsNotCalledFree) {
  Config config;
  config.addText(
      "world: {}\n"
      "stick(world): { joint: quatBall, shape: capsule, size: [1 .1], contact: 1 } \n"
      "ball: { X: \"t(.5 0 0)\", shape: sphere, size: [.1], contact: 1 }");
  EdgeChecker checker(config.state());
  const Eigen::Vector4d one(1., 0., 0., 0.), minus = -one, two = 2. * one;
  EXPECT_FALSE(checker.isFree(one.data(), minus.data()));
  EXPECT_TRUE(checker.isFree(one.data(), two.data())) << "only the norm changes";
}
