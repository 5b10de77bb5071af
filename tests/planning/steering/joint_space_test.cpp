#include "kinegraph/planning/steering/joint_space.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {
namespace {

constexpr double kExact = 1e-14;

/// A hinge with limits, an endless one, and a ball joint.
Config threeJoints() {
  Config C;
  C.addText(R"(
world: {}
a(world): {joint: hingeX, limits: [-1, 1]}
b(a): {joint: hingeZ}
c(b): {joint: quatBall}
)");
  return C;
}

TEST(JointSpace, AnEndlessJointTakesTheShorterWayAround) {
  const Config C = threeJoints();
  const JointSpace space(*C.model());
  VectorXd from{{0., 3., 1., 0., 0., 0.}}, to{{.5, -3., 1., 0., 0., 0.}};
  const VectorXd change = space.difference(from, to);
  EXPECT_NEAR(change[0], .5, kExact);
  EXPECT_NEAR(change[1], 2. * M_PI - 6., kExact);
  EXPECT_NEAR(space.distance(from, to), std::hypot(.5, 2. * M_PI - 6.), kExact);
}

TEST(JointSpace, BothSignsOfAQuaternionAreOneRotation) {
  const Config C = threeJoints();
  const JointSpace space(*C.model());
  VectorXd from{{0., 0., 1., 0., 0., 0.}}, to{{0., 0., -1., 0., 0., 0.}};
  EXPECT_NEAR(space.distance(from, to), 0., kExact);
  EXPECT_TRUE(space.difference(from, to).isZero(kExact));
}

TEST(JointSpace, SmallRotationsAreAsFarAsTheirAngle) {
  const Config C = threeJoints();
  const JointSpace space(*C.model());
  VectorXd from{{0., 0., 1., 0., 0., 0.}}, to{{0., 0., std::cos(.005), std::sin(.005), 0., 0.}};
  EXPECT_NEAR(space.distance(from, to), .01, 1e-6);
}

TEST(JointSpace, DrawsKeepLimitsAndLengthOne) {
  const Config C = threeJoints();
  const JointSpace space(*C.model());
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const VectorXd q = space.sample(rng, C.getJointState());
    EXPECT_LE(std::abs(q[0]), 1.);
    EXPECT_LE(std::abs(q[1]), M_PI);
    EXPECT_NEAR(q.tail(4).norm(), 1., 1e-12);
  }
}

TEST(JointSpace, AnUnrolledPathCountsTurnsAndKeepsSigns) {
  const Config C = threeJoints();
  const JointSpace space(*C.model());
  std::vector<VectorXd> points;
  for (int i = 0; i <= 8; ++i) {
    const double angle = std::remainder(i * 1.5, 2. * M_PI), sign = i % 2 ? -1. : 1.;
    points.push_back(VectorXd{{0., angle, sign, 0., 0., 0.}});
  }
  const MatrixXd path = space.unroll(points);
  for (int i = 0; i <= 8; ++i) {
    EXPECT_NEAR(path(i, 1), i * 1.5, 1e-12);
    EXPECT_EQ(path(i, 2), 1.);
  }
  EXPECT_NEAR(pathLength(space, path), 12., 1e-12);
}

TEST(JointSpace, AnAngleThatAMimicHalvesIsNotEndless) {
  Config C;
  C.addText("world: {}\na(world): {joint: hingeX}\nb(world): {joint: hingeY, mimic: a, joint_scale: 0.5}");
  EXPECT_EQ(JointSpace(*C.model()).dofsWithoutRange(), std::vector<std::string>{"a"});
}

TEST(JointSpace, WhatSlidesWithoutLimitsIsNamed) {
  Config C;
  C.addText("world: {}\nbase(world): {joint: transXYPhi}");
  const JointSpace space(*C.model());
  EXPECT_EQ(space.dofsWithoutRange(), (std::vector<std::string>{"base:0", "base:1"}));
  EXPECT_THROW(space.requireRanges("test"), ValueError);
}

TEST(JointSpace, TheDofFarthestBeyondItsLimitsIsTold) {
  const Config C = threeJoints();
  const JointSpace space(*C.model());
  VectorXd q = C.getJointState();
  q[0] = 1. + 1e-6;
  EXPECT_EQ(space.beyondLimits(q, 1e-5), "");
  q[0] = -1.25;
  EXPECT_EQ(space.beyondLimits(q, 1e-5), "a is at -1.25, 0.25 beyond its limits -1 to 1");
  space.clamp(q);
  EXPECT_EQ(q[0], -1.);
}

}  // namespace
}  // namespace kinegraph
