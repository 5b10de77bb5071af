#include "kinegraph/kinematics/joint.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"

using namespace kinegraph;

namespace {
const Vector3d kAxis = Vector3d(0, 1, 1).normalized();

Vector7d poseOf(JointType type, std::vector<double> q, const char* code = "") {
  return motionPose(motionSteps(type, code), kAxis, 1., q.data()).numbers();
}
}  // namespace

TEST(Joint, PosesAreThoseRecordedFromTheReference) {
  EXPECT_LT((poseOf(JointType::phiTransXY, {.1, .2, .3}).head<3>() - Vector3d(.16905, .31847, 0)).norm(), 1e-5);
  EXPECT_LT((poseOf(JointType::universal, {.1, .2}).tail<4>() - Vector4d(.99376, .04973, .09971, .00499)).norm(), 1e-5);
  EXPECT_LT((poseOf(JointType::hinge, {.5}).tail<4>() - Vector4d(.9689, 0, .1749, .1749)).norm(), 1e-4);
  const Vector7d generic = poseOf(JointType::generic, {.1, .2, .3, .4, .5, .6}, "zxyABC");
  EXPECT_LT((generic.head<3>() - Vector3d(.2, .3, .1)).norm(), 1e-15);
  EXPECT_LT((generic.tail<4>() - Vector4d(.92171, -.11224, -.28853, -.23367)).norm(), 1e-5);
}

TEST(Joint, ProjectionFindsTheDofsAgain) {
  Rng rng(3);
  for (const auto& [name, type] : jointTypeNames()) {
    const auto steps = motionSteps(type, "xyZaBc");
    for (double scale : {1., -1., .5}) {
      VectorXd q = motionIdentity(steps);
      for (double& x : q) x += rng.uniform(-.4, .4);
      const Pose X = motionPose(steps, kAxis, scale, q.data());
      const VectorXd found = motionProject(steps, kAxis, scale, X);
      const Pose again = motionPose(steps, kAxis, scale, found.data());
      EXPECT_TRUE((X.inverse() * again).isIdentity(1e-12)) << name << " scale " << scale;
    }
  }
}

TEST(Joint, TypesAreListedInTheOrderOfTheirNumbers) {
  for (std::size_t i = 0; i < jointTypeNames().size(); ++i) EXPECT_EQ(std::size_t(jointTypeNames()[i].second), i);
  EXPECT_EQ(jointTypeName(JointType::quatBall), "quatBall");
  EXPECT_EQ(jointTypeName(JointType(99)), "joint type 99");
  EXPECT_THROW(motionSteps(JointType(99)), ValueError);
  EXPECT_THROW(motionSteps(JointType(-1)), ValueError);
}

TEST(Joint, MotionsDoWhatTheListOfTheirKindsSays) {
  Rng rng(5);
  for (std::size_t i = 0; i < std::size(kMotionFacts); ++i) {
    const MotionFacts& facts = kMotionFacts[i];
    ASSERT_EQ(std::size_t(facts.kind), i);
    const std::vector<MotionStep> steps = {{facts.kind, 2}};
    const VectorXd rest = motionIdentity(steps);
    ASSERT_EQ(rest.size(), facts.dofs);
    EXPECT_TRUE(motionPose(steps, kAxis, 1., rest.data()).isIdentity(0.));
    VectorXd q = rest;
    for (double& x : q) x += rng.uniform(.1, .4);
    const Pose X = motionPose(steps, kAxis, 1., q.data());
    const VectorXd longer = 3. * q;
    EXPECT_EQ(X.p.isZero(0.), !steps[0].translates());
    EXPECT_EQ(X.q.angularDistance(Quaterniond::Identity()) < 1e-3, !steps[0].rotates() && !steps[0].orients());
    EXPECT_EQ(X.isIdentity(0.), !steps[0].moves());
    if (steps[0].translates()) EXPECT_LT((X.p - q[0] * steps[0].direction(kAxis)).norm(), 1e-15);
    if (steps[0].rotates()) EXPECT_LT((X.q.vec().normalized() - steps[0].direction(kAxis)).norm(), 1e-15);
    if (steps[0].orients())
      EXPECT_TRUE((X.inverse() * motionPose(steps, kAxis, 1., longer.data())).isIdentity(1e-15))
          << "only the direction";
  }
}

TEST(Joint, TypesWithInversesReachThoseOfTheirMotionsAndNoOthersDo) {
  Rng rng(4);
  for (const auto& [name, type] : jointTypeNames()) {
    if (type == JointType::generic || type == JointType::none || type == JointType::tau) continue;
    const std::vector<MotionStep> steps = motionSteps(type);
    double worst = 0.;
    for (int trial = 0; trial < 10; ++trial) {
      VectorXd q = motionIdentity(steps);
      for (double& x : q) x += rng.uniform(-.5, .5);
      const Pose X = motionPose(steps, kAxis, 1., q.data());
      const Pose back = motionPose(steps, kAxis, 1., motionProject(steps, kAxis, 1., X.inverse()).data());
      worst = std::max({worst, (X * back).p.norm(), (X * back).q.vec().norm()});
    }
    EXPECT_EQ(worst < 1e-12, hasInverses(type)) << name << " misses by " << worst;
  }
}

TEST(Joint, NamesRoundTripAndMistakesAreExplained) {
  for (const auto& [name, type] : jointTypeNames()) EXPECT_EQ(jointTypeFromName("JT_" + name), type);
  try {
    jointTypeFromName("hingZ");
    FAIL();
  } catch (const ValueError& error) {
    EXPECT_NE(std::string(error.what()).find("similar names: hingeZ"), std::string::npos) << error.what();
  }
  EXPECT_THROW(motionSteps(JointType::generic, "xq"), ValueError);
}
