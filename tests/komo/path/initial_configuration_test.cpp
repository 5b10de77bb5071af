#include "kinegraph/komo/path/initial_configuration.h"

#include <gtest/gtest.h>

#include "kinegraph/scene/tree/scene_tree.h"

using namespace kinegraph;

namespace {

Config arm() {
  Config config;
  config.addText(R"(
    world: {}
    base (world): { joint: transXYPhi, q: [1, 2, 3] }
    elbow (base): { joint: hingeZ, q: .5, note: kept }
    twin (base): { joint: hingeZ, mimic: elbow }
    door (world): { joint: hingeX, joint_active: false }
    stone (world): { Q: [1, 0, 0] }
    ring (elbow): { Q: [0, 1, 0] }
  )");
  config.getFrame("base").data().joint->stable = true;
  return config;
}

}  // namespace

TEST(InitialConfiguration, KnowsTheJointsThatMakeUpQ) {
  const Config config = arm();
  const InitialConfiguration given(config);
  const int base = config.getFrame("base").id(), elbow = config.getFrame("elbow").id();
  EXPECT_EQ(given.joint_frames, (std::vector<int>{base, elbow}));  // the twin mimics, the door is inactive
  EXPECT_EQ(given.q, config.getJointState());
  EXPECT_TRUE(given.isShared(base));
  EXPECT_FALSE(given.isShared(elbow));
  EXPECT_TRUE(InitialConfiguration().empty());
}

TEST(InitialConfiguration, IgnoresLaterEdits) {
  Config config = arm();
  const InitialConfiguration given(config);
  const VectorXd before = config.getJointState();
  config.setJointState(VectorXd::Zero(4));
  config.addFrame("later");
  const Config copy = given.config();
  EXPECT_EQ(copy.getJointState(), before);
  EXPECT_FALSE(copy.findFrame("later").has_value());
  EXPECT_NE(copy.getFrame("elbow").attributes().find("note"), nullptr);
}

TEST(InitialConfiguration, TakesOverThePosesThatNoJointMoves) {
  Config config = arm();
  InitialConfiguration given(config);
  Config edited = config;
  edited.getFrame("stone").setPosition({0., 0., 7.});
  edited.getFrame("ring").setRelativePosition({0., 0., 3.});
  edited.setJointState(VectorXd::Zero(4));
  given.transferPoses(edited);
  const Config now = given.config();
  EXPECT_EQ(now.getFrame("stone").getPose().p, Vector3d(0., 0., 7.));
  EXPECT_EQ(now.getFrame("ring").getRelativePose().p, Vector3d(0., 0., 3.));
  EXPECT_EQ(now.getJointState(), config.getJointState());
}

TEST(InitialConfiguration, FramesThatHangElsewhereKeepTheirPose) {
  Config config = arm(), edited = config;
  edited.getFrame("stone").setPosition({0., 0., 7.});
  Config moved = config;
  moved.getFrame("stone").setParent(moved.getFrame("base"));
  const Vector3d before = moved.getFrame("stone").getRelativePose().p;
  transferPoses(*moved.scene(), edited);
  EXPECT_EQ(moved.getFrame("stone").getRelativePose().p, before);
}
