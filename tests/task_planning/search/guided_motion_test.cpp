#include "kinegraph/task_planning/motions/guided_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kinegraph {
namespace {

/// A hand that slides in the plane and turns, at the handle of a door whose hinge is at the origin, .4 m away.
Config handAtDoor(const std::string& handle) {
  Config C;
  C.addFrame("world");
  C.addFrame("carriage", "world", "joint: transXY, limits: [-1 -1 1 1], q: [.4 0]");
  C.addFrame("gripper", "carriage", "joint: hingeZ, limits: [-3 3], shape: marker, size: [.03], opening: .08");
  C.addFrame("door", "world", "joint: hingeZ, limits: [0 1.5], q: [0], logical: { is_door }");
  C.addFrame("handle", "door", "rel: [.4 0 0], logical: { is_handle }, shape: " + handle);
  return C;
}

TEST(GuidedMotion, TheHandGoesOnTheCircleOfTheHandle) {
  const Config C = handAtDoor("ssBox, size: [.02 .02 .1 .004]");
  const VectorXd q0 = C.getJointState(), q1 = Vector4d(.4 * std::cos(1.2), .4 * std::sin(1.2), 1.2, 1.2);
  const MatrixXd rows = guidedConfigurations(C, q0, q1, gripConstraints(C, "gripper", "handle"));
  ASSERT_GT(rows.rows(), 50);
  EXPECT_EQ(VectorXd(rows.row(rows.rows() - 1)), q1);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    EXPECT_NEAR(rows(i, 0), .4 * std::cos(rows(i, 3)), 1e-4);
    EXPECT_NEAR(rows(i, 1), .4 * std::sin(rows(i, 3)), 1e-4);
    EXPECT_NEAR(rows(i, 2), rows(i, 3), 1e-3);
  }
  const Slip slip = mostSlip(C, rows, "gripper", "handle");
  EXPECT_LT(slip.distance, 2e-4);
  EXPECT_GT(slip.cosine, 1. - 1e-6);
}

TEST(GuidedMotion, HowAHandMayTurnDependsOnTheHandle) {
  const VectorXd turned = Vector4d(.4, 0., .5, 0.), away = Vector4d(.4, .002, 0., 0.);
  for (const auto& [handle, cosine] :
       {std::pair("ssBox, size: [.02 .02 .1 .004]", std::cos(.5)), std::pair("capsule, size: [.1 .01]", 1.),
        std::pair("sphere, size: [.02]", 1.)}) {
    const Config taken = handAtDoor(handle);
    Config now = taken;
    now.setJointState(turned);
    EXPECT_NEAR(slipOf(taken, now, "gripper", "handle").cosine, cosine, 1e-9) << handle;
    now.setJointState(away);
    EXPECT_NEAR(slipOf(taken, now, "gripper", "handle").distance, .002, 1e-9) << handle;
  }
}

TEST(GuidedMotion, ASlipBetweenTwoRowsIsSeen) {
  const Config C = handAtDoor("ssBox, size: [.02 .02 .1 .004]");
  MatrixXd rows(2, 4);
  rows << .4, 0., 0., 0., .4 * std::cos(1.2), .4 * std::sin(1.2), 1.2, 1.2;  // along the chord of the circle
  EXPECT_NEAR(mostSlip(C, rows, "gripper", "handle").distance, .4 * (1. - std::cos(.6)), 1e-3);
}

TEST(GuidedMotion, EndsAtWhichTheHandleIsNotHeldHaveNoMotion) {
  const Config C = handAtDoor("ssBox, size: [.02 .02 .1 .004]");
  const VectorXd elsewhere = Vector4d(-.9, .9, 0., 1.2);
  const MatrixXd rows = guidedConfigurations(C, C.getJointState(), elsewhere, gripConstraints(C, "gripper", "handle"));
  EXPECT_TRUE(rows.rows() == 0 || mostSlip(C, rows, "gripper", "handle").distance > .1);
}

}  // namespace
}  // namespace kinegraph
