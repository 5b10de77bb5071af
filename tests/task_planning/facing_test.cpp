#include "kinegraph/task_planning/facing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace kinegraph {
namespace {

/// An arm with a vertical hinge at the origin, and a hand 50 cm in front of it, along x.
Config armAhead(const std::string& joint, const std::string& limits = "[-6.28 6.28]") {
  Config C;
  C.addFrame("world");
  C.addFrame("pan", "world", "joint: " + joint + ", limits: " + limits);
  C.addFrame("hand", "pan", "shape: marker, size: [.03], rel: [.5 0 .2]");
  return C;
}

Vector3d handAt(Config C, const VectorXd& q) {
  C.setJointState(q);
  return C.getFrame("hand").getPosition();
}

TEST(Facing, TurnsAnArmWhoseHandIsBehindIt) {
  const Config C = armAhead("hingeZ");
  const Vector3d hand = handAt(C, facing(C, "hand", {-.6, .2, 0.}));
  EXPECT_NEAR(std::atan2(hand.y(), hand.x()), std::atan2(.2, -.6), 1e-9);
}

TEST(Facing, LeavesAnArmThatIsBesideThePoint) {
  const Config C = armAhead("hingeZ");
  EXPECT_EQ(facing(C, "hand", {-.1, .5, 0.}), C.getJointState());
  EXPECT_EQ(facing(C, "hand", {0., 0., .3}), C.getJointState());  // on the axis
}

TEST(Facing, TurnsTheOtherWayRoundAtALimit) {
  const Config C = armAhead("hingeZ", "[-4 1]");
  const VectorXd q = facing(C, "hand", {-.6, .2, 0.});
  EXPECT_NEAR(q[0], std::atan2(.2, -.6) - 2. * std::numbers::pi, 1e-9);
  EXPECT_EQ(facing(armAhead("hingeZ", "[-1 1]"), "hand", {-.6, .2, 0.})[0], 0.);
}

TEST(Facing, AcceptsLevelAxesAndBasesThatDriveAsTheyAre) {
  const Config C = armAhead("hingeY");
  EXPECT_EQ(facing(C, "hand", {-.6, .2, 0.}), C.getJointState());
  const Config driving = armAhead("transXYPhi", "[-9 -9 -9 9 9 9]");
  EXPECT_EQ(facing(driving, "hand", {-.6, .2, 0.}), driving.getJointState());
}

}  // namespace
}  // namespace kinegraph
