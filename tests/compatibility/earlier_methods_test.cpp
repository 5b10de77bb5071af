#include "kinegraph/compatibility/earlier_methods.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

/// A point mass of 1 kg on a massless rod of 1 m that hangs down.
constexpr const char* kPendulum =
    "base: { pose: [0 0 2] } joint (base): { joint: hingeX, swing } bob (joint): { pose: [0 0 -1], mass: 1, inertia: "
    "[0 0 0], com: [0 0 0] }";

}  // namespace

TEST(SelectJointsByTag, TakesTheJointsWithTheAttribute) {
  Config config;
  config.addText("a: {} b (a): { joint: hingeX, arm } c (b): { joint: transXY, hand } d (c): { joint: hingeX, arm }");
  selectJointsByTag(config, {"arm"});
  EXPECT_EQ(config.getJointNames(), (std::vector<std::string>{"b", "d"}));
  selectJointsByTag(config, {"arm"}, true);
  EXPECT_EQ(config.getJointNames(), (std::vector<std::string>{"c:0", "c:1"}));
  expectError<ValueError>([&] { selectJointsByTag(config, {"amr"}); }, {"the attribute 'amr'", "similar names: arm"});
}

TEST(MakeObjectsFree, FreesTheLinkAboveAndLeavesItInPlace) {
  Config config;
  config.addText(
      "world: {} table (world): { joint: rigid, pose: [0 0 1] } box (table): { joint: rigid, pose: [1 0 0] } lid "
      "(box): { pose: [0 0 .1] } "
      "loose: { pose: [3 0 0] }");
  makeObjectsFree(config, {"lid", "loose"});
  EXPECT_EQ(config.getFrame("box").getJointType(), JointType::free);
  EXPECT_EQ(config.getFrame("table").getJointType(), JointType::rigid);
  EXPECT_EQ(config.getJointState().size(), 14);
  EXPECT_TRUE(config.getFrame("lid").getPose().p.isApprox(Vector3d(1., 0., 1.1)));
  EXPECT_TRUE(config.getFrame("loose").getPose().p.isApprox(Vector3d(3., 0., 0.)));
  expectError<ValueError>([&] { makeObjectsFree(config, {"world"}); }, {"'world' is the first frame"});
  expectError<FrameNotFound>([&] { makeObjectsFree(config, {"bx"}); }, {"bx"});
}

TEST(StepDynamics, APendulumKeepsItsEnergy) {
  Config config;
  config.addText(kPendulum);
  Rng rng;
  config.setJointState(VectorXd::Constant(1, 1.));
  VectorXd velocity = VectorXd::Zero(1), none = VectorXd::Zero(1);
  for (int i = 0; i < 100; ++i) velocity = stepDynamics(config, velocity, none, .01, 0., true, rng);
  const double angle = config.getJointState()[0];
  EXPECT_LT(angle, 0.);  // it has swung through
  EXPECT_NEAR(.5 * velocity[0] * velocity[0] - 9.81 * std::cos(angle), -9.81 * std::cos(1.), 1e-5);
}

TEST(StepDynamics, WithoutGravityAForceAccelerates) {
  Config config;
  config.addText(kPendulum);
  Rng rng;
  const VectorXd velocity = stepDynamics(config, VectorXd::Zero(1), VectorXd::Constant(1, 2.), .1, 0., false, rng);
  EXPECT_NEAR(velocity[0], .2, 1e-9);
  EXPECT_NEAR(config.getJointState()[0], .01, 1e-9);
  expectError<ValueError>([&] { stepDynamics(config, VectorXd::Zero(2), VectorXd::Zero(1), .1, 0., true, rng); },
                          {"1 active dofs"});
  expectError<ValueError>([&] { stepDynamics(config, VectorXd::Zero(1), VectorXd::Zero(1), 0., 0., true, rng); },
                          {"tau"});
}
