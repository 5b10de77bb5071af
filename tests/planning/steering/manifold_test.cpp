#include "kinegraph/planning/steering/manifold.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"
#include "kinegraph/features/eval.h"
#include "kinegraph/planning/plan_motion.h"

namespace kinegraph {
namespace {

/// Two revolute links of 1 m and .8 m on a prismatic joint, its tip, and a frame beside it.
Config arm() {
  Config C;
  C.addText(R"(
world: {}
slide(world): {joint: transX, limits: [-1, 1]}
first(slide): {joint: hingeZ, limits: [-3, 3]}
elbow(first): {Q: [1, 0, 0]}
second(elbow): {joint: hingeY, limits: [-3, 3]}
tip(second): {Q: [.8, 0, .1]}
post(world): {Q: [.5, .5, .2, .9, .1, .3, -.2]}
side(first): {Q: [.1, .2, .3]}
)");
  return C;
}

double violationAt(Config& C, const MotionConstraint& constraint, const VectorXd& q) {
  State state = C.state();
  state.setJoints(q.data());
  const JointSpace space(state.model());
  Manifold manifold(state, space, {constraint}, 1.);
  return manifold.violation(q);
}

/// Checks at many samples that constraints hold if holdsAlong says so.
TEST(Manifold, NothingIsViolatedAlongAMotionAlongWhichItHolds) {
  Config C = arm();
  const JointSpace space(*C.model());
  const std::vector<MotionConstraint> constraints = {
      {FeatureSymbol::position, {"tip"}},
      {FeatureSymbol::positionDiff, {"tip", "side"}},
      {FeatureSymbol::positionRel, {"tip", "side"}},
      {FeatureSymbol::positionRel, {"post", "tip"}},
      {FeatureSymbol::quaternion, {"tip"}},
      {FeatureSymbol::quaternionRel, {"tip", "side"}},
      {FeatureSymbol::vectorZ, {"tip"}},
      {FeatureSymbol::vectorXDiff, {"tip", "side"}},
      {FeatureSymbol::vectorYRel, {"tip", "post"}},
      {FeatureSymbol::scalarProductXZ, {"tip", "post"}},
      {FeatureSymbol::pose, {"tip"}},
      {FeatureSymbol::qItself, {}},
  };
  Rng rng(3);
  for (MotionConstraint constraint : constraints) {
    int held = 0, refused = 0;
    for (int i = 0; i < 60; ++i) {
      VectorXd from(3), to(3);
      for (double& value : from) value = rng.uniform(-1., 1.);
      const double length = std::pow(10., rng.uniform(-3., 0.));
      for (int j = 0; j < 3; ++j) to[j] = from[j] + length * rng.uniform(-1., 1.);
      C.setJointState(.5 * (from + to));
      constraint.target = Target(C.eval(constraint.feature, constraint.frames).y);
      Manifold manifold(C.state(), space, {constraint}, .01);
      EXPECT_TRUE(manifold.sampled().empty()) << constraint.feature.name();
      const double stray = i % 2 ? .001 : 0.;
      if (!manifold.holdsAlong(from, to, .3, stray)) {
        ++refused;
        continue;
      }
      ++held;
      for (int k = 0; k <= 200; ++k) {
        VectorXd q = from + k / 200. * (to - from);
        for (double& value : q) value += rng.uniform(-stray, stray);
        ASSERT_LE(manifold.violation(q), .01) << constraint.feature.name();
      }
    }
    EXPECT_GT(held, 5) << constraint.feature.name();
    EXPECT_GT(refused, 5) << constraint.feature.name();
  }
}

TEST(Manifold, WhatIsViolatedBetweenTwoPosturesThatAreLookedAtIsFound) {
  Config C = arm();
  const JointSpace space(*C.model());
  const VectorXd from{{0., -.01, 0.}}, to{{0., .01, 0.}};  // x = .8 + cos, .05 mm larger in the middle
  C.setJointState(from);
  const VectorXd at_ends = C.eval(FeatureSymbol::position, {"tip"}).y;
  const MotionConstraint far{FeatureSymbol::position, {"tip"}, ObjectiveType::ineq, MatrixXd{{1., 0., 0.}}, at_ends};
  ASSERT_GT(violationAt(C, far, VectorXd::Zero(3)), 8e-5);
  EXPECT_FALSE(Manifold(C.state(), space, {far}, 8e-5).holdsAlong(from, to, 1.));
  EXPECT_TRUE(Manifold(C.state(), space, {far}, 1e-4).holdsAlong(from, to, 1.));
}

TEST(Manifold, FeaturesWithoutBoundsAreTold) {
  Config C = arm();
  const JointSpace space(*C.model());
  const MotionConstraint product{FeatureSymbol::jointLimits, {}, ObjectiveType::ineq};
  EXPECT_TRUE(Manifold(C.state(), space, {product}, 1e-3).sampled().empty());
  const MotionConstraint energy{FeatureSymbol::quaternion, {"tip"}, ObjectiveType::eq, MatrixXd{{1., 0., 0., 0.}}};
  EXPECT_EQ(Manifold(C.state(), space, {energy}, 1e-3).sampled().size(), 1u);
}

}  // namespace
}  // namespace kinegraph
