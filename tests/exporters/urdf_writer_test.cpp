#include "kinegraph/exporters/writers.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "kinegraph/gfile/writer.h"
#include "kinegraph/parsers/urdf/urdf_reader.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "tests/exporters/random_scene.h"
#include "tests/support/scene.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

Config fromUrdf(const std::string& text) {
  const ParseResult read = readUrdf(text, "r.urdf", "/");
  for (const Diagnostic& diagnostic : read.diagnostics) ADD_FAILURE() << diagnostic.message;
  return scene(writeFile(read.graph));
}

constexpr const char* kRobotWithMimic = R"(<robot name="r">
  <link name="base">
    <inertial><origin xyz="0 0 .1"/><mass value="2"/><inertia ixx="1" ixy=".1" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <visual><geometry><box size="1 1 .1"/></geometry><material name="m"><color rgba="1 0 0 1"/></material></visual>
    <collision><origin xyz="0 0 .5"/><geometry><sphere radius=".2"/></geometry></collision>
  </link>
  <link name="arm"/> <link name="tip"/> <link name="cart"/> <link name="follower"/>
  <joint name="shoulder" type="revolute"><origin xyz="0 0 1" rpy=".1 1.5707963267948966 .2"/><parent link="base"/><child link="arm"/>
    <axis xyz="0 .6 -.8"/><limit lower="-1" upper="2" effort="7" velocity="3"/></joint>
  <joint name="wrist" type="fixed"><origin xyz="1 0 0"/><parent link="arm"/><child link="tip"/></joint>
  <joint name="rail" type="prismatic"><parent link="base"/><child link="cart"/><axis xyz="1 1 0"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint>
  <joint name="copy" type="continuous"><parent link="tip"/><child link="follower"/><axis xyz="0 0 1"/><mimic joint="shoulder" multiplier="-2" offset=".1"/></joint>
</robot>)";

}  // namespace

TEST(WriteUrdf, ARobotReadFromUrdfComesBackWithTheSameNamesAndPoses) {
  Config robot = fromUrdf(kRobotWithMimic);
  Config back = fromUrdf(writeUrdf(robot));
  EXPECT_EQ(back.getJointNames(), robot.getJointNames());
  EXPECT_EQ(back.getJointLimits(), robot.getJointLimits());
  Rng rng(0);
  for (int sample = 0; sample < 5; ++sample) {
    const Eigen::Vector2d q(rng.normal(), rng.normal());
    robot.setJointState(q);
    back.setJointState(q);
    for (const char* name :
         {"base", "arm", "tip", "cart", "follower", "shoulder", "wrist", "copy", "base_0", "base_1"}) {
      EXPECT_TRUE((robot.getFrame(name).getPose().inverse() * back.getFrame(name).getPose()).isIdentity(1e-13)) << name;
    }
  }
  EXPECT_EQ(back.getFrame("base").getInertia()->com, Vector3d(0, 0, .1));
  EXPECT_EQ(back.getFrame("base").getInertia()->matrix, robot.getFrame("base").getInertia()->matrix);
  EXPECT_EQ(back.getFrame("base_0").data().shape->color, Vector4d(1, 0, 0, 1));
  EXPECT_EQ(back.getFrame("base_1").data().shape->contact, -2);
  EXPECT_EQ(*back.getFrame("shoulder").attributes().find("ctrl_limits"),
            *robot.getFrame("shoulder").attributes().find("ctrl_limits"));
}

TEST(WriteUrdf, FramesOfGeneratedScenesAreWhereTheyWereAtZero) {
  Rng rng(2);
  for (int sample = 0; sample < 200; ++sample) {
    Config config = randomScene(rng, true);
    for (const auto& frame : config.scene()->frames()) {
      if (frame->moves()) frame->joint->q = motionIdentity(frame->joint->steps);
    }
    config.scene()->jointsChanged();
    const std::string text = writeUrdf(config);
    SCOPED_TRACE(text);
    const Config back = fromUrdf(text);
    for (const auto& frame : config.scene()->frames()) {
      const std::string link = frame->moves() && !back.findFrame(frame->name) ? frame->name + "_link" : frame->name;
      const auto found = back.findFrame(link);
      if (!found) continue;  // a chain of joints, named after its parts
      EXPECT_TRUE((frame->worldPose().inverse() * found->getPose()).isIdentity(1e-12)) << frame->name;
    }
    if (HasFailure()) break;
  }
}

TEST(WriteUrdf, JointsOfOneDofMoveAlike) {
  for (const char* type : {"hingeX", "hingeY", "hingeZ", "transX", "transY", "transZ", "hinge, axis: [1 2 3]"}) {
    for (const char* scale : {"1", "-1"}) {
      Config config = scene(std::string("a: {} j(a): { joint: ") + type + ", joint_scale: " + scale +
                            " } tip(j): { pose: [1 2 3 1 0 0 1] }");
      Config back = fromUrdf(writeUrdf(config));
      config.setJointState(VectorXd::Constant(1, .7));
      ASSERT_EQ(back.getJointNames(), std::vector<std::string>{"j"});
      back.setJointState(VectorXd::Constant(1, .7));
      EXPECT_TRUE((config.getFrame("tip").getPose().inverse() * back.getFrame("tip").getPose()).isIdentity(1e-14))
          << type << scale;
    }
  }
}

TEST(WriteUrdf, AJointOfSeveralDofsIsAChain) {
  Config config = scene("a: {} u(a): { joint: universal, limits: [-1 -2 1 2] } tip(u): { pose: [0 0 1] }");
  Config back = fromUrdf(writeUrdf(config));
  EXPECT_EQ(back.getJointNames(), (std::vector<std::string>{"u_0", "u_1"}));
  EXPECT_EQ(back.getJointLimits(), config.getJointLimits());
  config.setJointState(Eigen::Vector2d(.3, .4));
  back.setJointState(Eigen::Vector2d(.3, .4));
  EXPECT_TRUE((config.getFrame("tip").getPose().inverse() * back.getFrame("tip").getPose()).isIdentity(1e-14));
}

TEST(WriteUrdf, ShapesWithoutAnElementOfTheirOwnBecomeMeshFiles) {
  const TemporaryFolder folder;
  const Config config = scene("a: { shape: ssCvx, size: [.1], core: [0 0 0 1 0 0 0 1 0 0 0 1] }");
  std::vector<std::string> warnings;
  EXPECT_EQ(writeUrdf(config, {}, &warnings).find("<mesh"), std::string::npos);
  EXPECT_EQ(warnings.size(), 1u);
  const Config back = fromUrdf(writeUrdf(config, {"r", folder.path().string()}));
  EXPECT_EQ(back.getFrame("a_0").getShapeType(), ShapeType::mesh);
}

TEST(WriteUrdf, AJointThatIsNoPartOfQIsFixedWhereItIsAndSaidSo) {
  const Config config = scene(
      "a: {} j (a): { joint: hingeX, q: .3 } f_origin (j): { pose: [0 0 1] } f (f_origin): { joint: transY, q: .04, "
      "joint_active: False } tip (f): { pose: [0 0 0 1 1 0 0] }");
  std::vector<std::string> warnings;
  Config back = fromUrdf(writeUrdf(config, {}, &warnings));
  EXPECT_EQ(back.getJointNames(), std::vector<std::string>{"j"});
  back.setJointState(config.getJointState());
  for (const char* name : {"f", "tip"})
    EXPECT_TRUE((config.getFrame(name).getPose().inverse() * back.getFrame(name).getPose()).isIdentity(1e-13)) << name;
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0], "joint 'f' is not in q (joint_active: false) and is fixed at q = 0.04");
  EXPECT_EQ(warnings[1], "URDF has no joint state and readers start at q = 0; joints at other values: j");
}

TEST(WriteUrdf, LostRoundingIsNamed) {
  std::vector<std::string> warnings;
  writeUrdf(scene("a: { shape: ssBox, size: [1 1 1 .1] } b (a): { shape: ssCylinder, size: [1 1 .1] }"), {}, &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("without their rounding: a, b"), std::string::npos);
}

namespace {

constexpr const char* kCollidingArm =
    "base: { shape: sphere, size: [.1], contact: FLAG } j1 (base): { joint: hingeX, shape: sphere, size: [.1], "
    "contact: FLAG "
    "} j2 (j1): { joint: hingeY, shape: sphere, size: [.1], contact: FLAG } j3 (j2): { joint: hingeY, shape: sphere, "
    "size: "
    "[.1], contact: FLAG } ";

std::string armWith(const std::string& flag) {
  std::string text = kCollidingArm;
  for (std::size_t at; (at = text.find("FLAG")) != std::string::npos;) text.replace(at, 4, flag);
  return text;
}

std::size_t pairsAfterSaving(const Config& config, std::vector<std::string>* warnings = nullptr) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "arm.urdf").string();
  saveUrdf(config, path, warnings);
  Config back;
  back.addFile(path);
  return back.getCollidablePairs().size();
}

}  // namespace

TEST(WriteSrdf, WritesEveryExcludedPairForAnyKindOfExclusion) {
  for (const char* flag : {"1", "-1", "-2", "-3"}) {
    const Config config = scene(armWith(flag));
    EXPECT_EQ(pairsAfterSaving(config), config.getCollidablePairs().size()) << flag;
    const Config excluded = scene(armWith(flag) + "Edit base: { contact_exclude: [j2, j3] }");
    EXPECT_EQ(pairsAfterSaving(excluded), excluded.getCollidablePairs().size()) << flag;
  }
}

TEST(WriteSrdf, IsNotNeededWhereTheRuleForUrdfFilesSaysTheSame) {
  EXPECT_EQ(writeSrdf(scene(armWith("-2"))), "");
  std::vector<std::string> warnings;
  writeUrdf(scene(armWith("-2")), {}, &warnings);
  EXPECT_TRUE(warnings.empty());
  writeUrdf(scene(armWith("-1")), {}, &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("the text lacks disabled collision pairs"), std::string::npos);
}

TEST(WriteSrdf, WhatHoldsOfSomeShapesOfALinkOnlyIsWarnedAbout) {
  const Config config = scene(
      "base: { shape: sphere, size: [.1], contact: 1 } base_0 (base): { pose: [0 0 1], shape: sphere, size: [.1], "
      "contact: 1 } "
      "j (base): { joint: hingeX, shape: sphere, size: [.1], contact: 1, contact_exclude: [base_0] }");
  std::vector<std::string> warnings;
  writeSrdf(config, {}, &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("base - j"), std::string::npos) << warnings[0];
}

TEST(WriteSrdf, GroupsAndStatesComeBack) {
  const TemporaryFolder folder;
  const Config config = scene(
      "a: {} j (a): { joint: hingeX, joint_groups: [arm], joint_states: { home: .5, arm: { ready: -1 } } } k (j): { "
      "joint: "
      "free, joint_states: { home: [1 2 3 .8 0 0 .6] } }");
  const std::string path = (folder.path() / "arm.urdf").string();
  saveUrdf(config, path);
  Config back;
  back.addFile(path);
  EXPECT_EQ(back.getStateNames(), config.getStateNames());
  EXPECT_EQ(back.getNamedState("ready")[0], -1.);
  EXPECT_TRUE(back.getNamedState("home").isApprox(config.getNamedState("home")));
  EXPECT_EQ(back.getJointGroups(), config.getJointGroups());
}
