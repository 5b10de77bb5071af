#include "kinegraph/parsers/mjcf/mjcf_reader.h"

#include <filesystem>
#include <fstream>

#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/scene/loading/scene_source.h"
#include "tests/exporters/mujoco_model.h"
#include "tests/support/expect_error.h"
#include "tests/support/near.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

/// Scenes read from MJCF texts, through files as users do it.
class MjcfReader : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) { return folder_.write(name, text); }
  std::string file(const std::string& inside) { return write("m.xml", "<mujoco>\n" + inside + "\n</mujoco>"); }

  Config load(const std::string& inside) {
    Config config;
    config.addFile(file(inside));
    warnings_ = config.takeWarnings();
    return config;
  }
  Config world(const std::string& inside) { return load("<worldbody>" + inside + "</worldbody>"); }

  double difference(const std::string& inside) {
    const std::string path = file(inside);
    Config config;
    config.addFile(path);
    return largestDifferenceToMujoco(path, config);
  }

  TemporaryFolder folder_;
  std::vector<std::string> warnings_;
};

constexpr double kReaderAgreement = 1e-9;

}  // namespace

TEST_F(MjcfReader, FramesAreNamedAfterWhatTheyStandFor) {
  const Config config = world(
      "<geom type='plane' size='0 0 1'/><body name='arm' pos='0 0 1'><joint name='turn' axis='0 1 0'/><geom size='.1'/>"
      "<geom name='tip' size='.2'/><site name='arm'/><camera name='eye'/><body><joint/></body></body>");
  EXPECT_EQ(config.getFrameNames(), (std::vector<std::string>{"world", "world_0", "turn_origin", "turn", "arm", "arm_0",
                                                              "tip", "arm_site", "eye", "arm_body"}));
  EXPECT_EQ(config.getJointNames(), (std::vector<std::string>{"turn", "arm_body"}));
  EXPECT_EQ(config.getFrame("turn").getJointType(), JointType::hingeY);
  EXPECT_EQ(config.getFrame("world_0").getShapeType(), ShapeType::plane);
  EXPECT_EQ(config.getFrame("eye").getShapeType(), ShapeType::camera);
}

TEST_F(MjcfReader, KeyframesAreNamedStates) {
  const std::string bodies =
      "<worldbody><body><freejoint name='root'/><geom size='.1'/><body><joint name='a'/><joint name='b' type='slide' "
      "axis='-1 0 0' ref='.1'/>"
      "<geom size='.1'/><body name='ball'><joint type='ball'/><geom size='.1'/><body><joint name='c'/><geom "
      "size='.1'/></body>"
      "</body></body></body></worldbody><equality><joint joint1='c' joint2='a'/></equality>";
  const Config config = load(bodies +
                             "<keyframe><key name='home' qpos='1 2 3 0 1 0 0  .4 .5  0 0 1 0  .4'/><key time='1'/>"
                             "<key name='short' qpos='1 2'/></keyframe>");
  EXPECT_EQ(config.getStateNames(), std::vector<std::string>{"home"});
  VectorXd expected(13);
  expected << 1, 2, 3, 0, 1, 0, 0, .4, .5, 0, 0, 1, 0;
  EXPECT_EQ(config.getNamedState("home"), expected);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("keyframe 'short': expected qpos to be 14 numbers, one per coordinate of a joint, not 2"),
            std::string::npos)
      << warnings_[0];
}

TEST_F(MjcfReader, EveryKindOfJointMovesAsInMujoco) {
  EXPECT_LT(
      difference(
          "<compiler angle='radian'/><worldbody>"
          "<body name='cube' pos='1 2 3' quat='1 2 3 4'><freejoint name='fly'/><geom size='.1'/></body>"
          "<body name='a' pos='.1 .2 .3' euler='.1 .2 .3'><geom size='.1'/>"
          "  <joint name='h' axis='1 2 3' pos='.3 .1 .2' ref='.4'/><joint name='s' type='slide' axis='0 -1 0' "
          "ref='.2'/>"
          "  <joint name='s2' type='slide' axis='1 1 0'/>"
          "  <body name='b' pos='0 0 1' axisangle='0 1 1 .7'><joint name='ball' type='ball' pos='.1 0 .2'/><geom "
          "size='.1'/>"
          "    <body name='c' pos='.5 0 0' xyaxes='0 1 0 -1 .2 .1'><joint axis='0 0 -1' pos='0 .1 0'/>"
          "      <joint axis='0 1 0' pos='0 .1 0'/><geom size='.1'/><site name='end' pos='.1 .2 .3' zaxis='1 1 1'/>"
          "</body></body></body></worldbody>"),
      kReaderAgreement);
}

TEST_F(MjcfReader, AnglesAreDegreesUnlessTheCompilerSaysRadian) {
  const Config degrees = world("<body name='a' euler='0 0 90'><joint name='j' range='-90 180'/></body>");
  EXPECT_TRUE(near(degrees.getJointLimits(), (MatrixXd(2, 1) << -M_PI / 2, M_PI).finished(), 1e-15));
  EXPECT_TRUE(near(degrees.getFrame("a").getPose().q.toRotationMatrix(), axisRotation(2, M_PI / 2), 1e-15));
  const Config radians =
      load("<compiler angle='radian'/><worldbody><body name='a'><joint name='j' range='-1 2'/></body></worldbody>");
  EXPECT_EQ(radians.getJointLimits(), (MatrixXd(2, 1) << -1, 2).finished());
}

TEST_F(MjcfReader, EulerSequencesRotateAboutFixedOrRotatedAxes) {
  for (const char* sequence : {"xyz", "zyx", "XYZ", "ZXZ", "xYz"}) {
    EXPECT_LT(difference(std::string("<compiler eulerseq='") + sequence +
                         "'/><worldbody><body name='a' euler='20 30 -40'><joint/><geom size='.1'/></body></worldbody>"),
              kReaderAgreement)
        << sequence;
  }
}

TEST_F(MjcfReader, ARangeLimitsUnlessTheCompilerOrTheJointSaysOtherwise) {
  const auto limited = [&](const char* compiler, const char* joint) {
    const Config config =
        load(std::string("<compiler ") + compiler + "/><worldbody><body><joint " + joint + "/></body></worldbody>");
    return config.getJointLimits().allFinite();
  };
  EXPECT_TRUE(limited("", "range='-1 1'"));
  EXPECT_FALSE(limited("", "range='-1 1' limited='false'"));
  EXPECT_FALSE(limited("autolimits='false'", "range='-1 1'"));
  EXPECT_TRUE(limited("autolimits='false'", "range='-1 1' limited='true'"));
}

TEST_F(MjcfReader, DefaultsComeFromTheNearestClass) {
  const std::string text =
      "<default><joint axis='0 1 0'/><geom size='.1 .2' type='capsule' rgba='1 0 0 1'/>"
      "<default class='in'><joint axis='1 0 0'/><default class='deep'><geom size='.3'/></default></default></default>"
      "<worldbody><body name='a' childclass='in'><joint name='j'/><geom name='g'/>"
      "<body name='b' pos='0 0 1'><joint name='k' class='main'/><geom name='h' class='deep'/>"
      "<body name='c' pos='0 1 0' childclass='main'><joint name='l'/><geom name='i'/></body></body></body></worldbody>";
  const Config config = load(text);
  EXPECT_EQ(config.getFrame("j").getJointType(), JointType::hingeX);
  EXPECT_EQ(config.getFrame("k").getJointType(), JointType::hingeY);
  EXPECT_EQ(config.getFrame("l").getJointType(), JointType::hingeY);
  EXPECT_EQ(config.getFrame("h").data().shape->geometry->size, (std::vector<double>{.4, .3}));
  EXPECT_EQ(config.getFrame("i").data().shape->geometry->size, (std::vector<double>{.4, .1}));
  EXPECT_EQ(config.getFrame("i").data().shape->color, Vector4d(1, 0, 0, 1));
  EXPECT_LT(difference(text), kReaderAgreement);
}

TEST_F(MjcfReader, ShapesHaveFullSizes) {
  const Config config = world(
      "<geom name='box' type='box' size='.1 .2 .3'/><geom name='ball' size='.1'/><geom name='can' type='cylinder' "
      "size='.1 .2'/>"
      "<geom name='egg' type='ellipsoid' size='.1 .2 .3'/><geom name='floor' type='plane' size='1 2 .1'/>"
      "<geom name='line' type='capsule' fromto='0 0 0 0 3 4' size='.1'/>");
  const auto size = [&](const char* name) { return config.getFrame(name).data().shape->geometry->size; };
  EXPECT_EQ(size("box"), (std::vector<double>{.2, .4, .6}));
  EXPECT_EQ(size("ball"), (std::vector<double>{.1}));
  EXPECT_EQ(size("can"), (std::vector<double>{.4, .1}));
  EXPECT_EQ(size("egg"), (std::vector<double>{0, 0, 0, .1, .2, .3, 0}));
  EXPECT_EQ(size("floor"), (std::vector<double>{2, 4}));
  EXPECT_EQ(size("line"), (std::vector<double>{5, .1}));
}

TEST_F(MjcfReader, LinesAndFramesPlaceShapesAsInMujoco) {
  EXPECT_LT(difference("<worldbody><geom name='up' type='capsule' fromto='0 0 0 0 0 1' size='.1'/>"
                       "<geom name='down' type='capsule' fromto='0 0 1 0 0 0' size='.1'/>"
                       "<geom name='across' type='cylinder' fromto='1 2 3 -1 .5 2' size='.1'/>"
                       "<geom name='bar' type='box' fromto='1 0 3 -1 .5 2' size='.1'/>"
                       "<frame pos='1 0 0' euler='10 20 30'><frame pos='0 0 .5'><geom name='in' type='box' size='.1 .2 "
                       ".3' pos='0 1 0'/>"
                       "<body name='b' pos='0 0 1' euler='0 40 0'><frame euler='0 0 50' pos='.1 0 0'>"
                       "<joint axis='1 0 0' pos='0 .2 0'/><geom name='g' size='.1' pos='1 0 "
                       "0'/></frame></body></frame></frame></worldbody>"),
            kReaderAgreement);
}

TEST_F(MjcfReader, ALinearEqualityIsAMimic) {
  const std::string bodies =
      "<worldbody><body name='a'><joint name='x' ref='10'/><geom size='.1'/>"
      "<body name='b' pos='1 0 0'><joint name='y' type='slide' axis='0 -1 0' ref='.3'/><geom size='.1'/></body></body>"
      "<body name='c'><joint name='z' axis='0 1 0'/><geom size='.1'/></body></worldbody>";
  const std::string chain = bodies +
                            "<equality><joint joint1='z' joint2='y' polycoef='.1 -2 0 0 0'/>"
                            "<joint joint1='y' joint2='x' polycoef='.2 .5'/></equality>";
  EXPECT_EQ(load(chain).getJointNames(), std::vector<std::string>{"x"});
  EXPECT_LT(difference(chain), kReaderAgreement);
  const std::string constant = bodies + "<equality><joint joint1='y' polycoef='.2'/></equality>";
  EXPECT_EQ(load(constant).getJointNames(), (std::vector<std::string>{"x", "z"}));
  EXPECT_LT(difference(constant), kReaderAgreement);
  const Config curved = load(bodies + "<equality><joint joint1='y' joint2='x' polycoef='0 1 2'/></equality>");
  EXPECT_EQ(curved.getJointDimension(), 3);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("not linear"), std::string::npos);
}

TEST_F(MjcfReader, JointsThatFollowEachOtherInACircleAreFree) {
  const Config config = load(
      "<worldbody><body><joint name='x'/></body><body><joint name='y'/></body></worldbody>"
      "<equality><joint joint1='x' joint2='y'/><joint joint1='y' joint2='x'/></equality>");
  EXPECT_EQ(config.getJointDimension(), 1);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("follows itself"), std::string::npos);
}

TEST_F(MjcfReader, WhatIsIncludedStandsInPlace) {
  std::filesystem::create_directories(folder_ / "parts");
  write("parts/arm.xml", "<mujocoinclude><body name='arm'><include file='tip.xml'/></body></mujocoinclude>");
  write("parts/tip.xml", "<mujoco>\n  <joint name='j' axiss='0 0 1'/></mujoco>");
  const std::string path = file("<worldbody><include file='parts/arm.xml'/></worldbody>");
  expectError<ParseError>(
      [&] { Config().addFile(path); },
      {"parts/tip.xml:2:19: unknown attribute 'axiss'", "did you mean 'axis'?", "  <joint name='j' axiss='0 0 1'/>"});
  write("parts/tip.xml", "<mujoco><joint name='j' axis='0 0 1'/></mujoco>");
  Config config;
  config.addFile(path);
  EXPECT_EQ(config.getJointNames(), std::vector<std::string>{"j"});
  EXPECT_EQ(sourceFiles(path).size(), 3u);
}

TEST_F(MjcfReader, AFileCannotIncludeItself) {
  write("a.xml", "<mujoco><include file='b.xml'/></mujoco>");
  write("b.xml", "<mujoco><include file='a.xml'/></mujoco>");
  expectError<ParseError>([&] { Config().addFile((folder_ / "a.xml").string()); }, {"b.xml:1:18", "includes itself"});
}

TEST_F(MjcfReader, MeshesAreLookedForInMeshdirAndScaled) {
  std::filesystem::create_directories(folder_ / "meshes");
  write("meshes/m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\nf 1 2 4\nf 2 3 4\n");
  const Config config = load(
      "<compiler meshdir='meshes'/><asset><mesh file='m.obj' scale='2 3 4'/><mesh name='lost' file='n.obj'/></asset>"
      "<worldbody><geom name='g' type='mesh' mesh='m'/><geom name='l' type='mesh' mesh='lost'/></worldbody>");
  const Geometry& geometry = *config.getFrame("g").data().shape->geometry;
  Vector3d top = Vector3d::Zero();
  for (const Vector3d& p : geometry.mesh->vertices) top = top.cwiseMax(p);
  EXPECT_EQ(top, Vector3d(2, 3, 4));
  EXPECT_EQ(config.getFrame("l").getShapeType(), ShapeType::none);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("mesh 'n.obj' does not exist"), std::string::npos);
}

TEST_F(MjcfReader, NeighborsAndExcludedBodiesDoNotCollide) {
  const std::string bodies =
      "<worldbody><geom name='floor' type='plane' size='1 1 1'/>"
      "<body name='a'><joint/><joint axis='1 0 0'/><geom name='ga' size='.1'/>"
      "<body name='fixed'><geom name='gf' size='.1'/><body name='b'><joint/><joint axis='1 0 0'/><geom name='gb' "
      "size='.1'/>"
      "<body name='c'><joint/><geom name='gc' size='.1'/><geom name='ghost' size='.1' contype='0' conaffinity='0'/>"
      "</body></body></body></body></worldbody>";
  const auto pairs = [&](const std::string& text) {
    const Config config = load(text);
    std::string out;
    for (const auto& [i, j] : config.getCollidablePairs())
      out += config.getFrame(i).data().name + "-" + config.getFrame(j).data().name + " ";
    return out;
  };
  EXPECT_EQ(pairs(bodies), "floor-ga floor-gf floor-gb floor-gc ga-gc gf-gc ");
  EXPECT_EQ(pairs(bodies + "<contact><exclude body1='a' body2='c'/><exclude body1='world' body2='a'/></contact>"),
            "floor-gf floor-gb floor-gc gf-gc ");
}

TEST_F(MjcfReader, ACameraLooksAlongItsZAxis) {
  const Config config = world("<camera name='eye' pos='0 0 2' fovy='30'/>");  // MuJoCo's looks down from there
  EXPECT_TRUE(near(config.getFrame("eye").getPose().q * Vector3d::UnitZ(), -Vector3d::UnitZ(), 1e-15));
  EXPECT_EQ(*config.getFrame("eye").attributes().find("heightAngle")->value.as<double>(), 30.);
}

TEST_F(MjcfReader, InertiasAreAboutTheCenterOfMass) {
  const Config config = world(
      "<body name='a'><inertial pos='1 2 3' mass='2' fullinertia='.3 .2 .25 .01 .02 .03'/></body>"
      "<body name='b'><inertial pos='0 0 0' mass='1' diaginertia='.1 .2 .3' quat='1 0 0 1'/></body>");
  const Inertia& a = *config.getFrame("a").data().inertia;
  EXPECT_EQ(a.com, Vector3d(1, 2, 3));
  EXPECT_TRUE(near(a.matrix, (Matrix3d() << .3, .01, .02, .01, .2, .03, .02, .03, .25).finished(), 1e-15));
  EXPECT_TRUE(
      near(config.getFrame("b").data().inertia->matrix, Vector3d(.2, .1, .3).asDiagonal().toDenseMatrix(), 1e-15));
}

TEST_F(MjcfReader, BodiesWithoutInertialWeighWhatTheirGeomsDo) {
  const std::string inside =
      "<default><geom density='500'/></default><worldbody><body name='a'><joint name='j'/>"
      "<geom type='box' size='.1 .2 .3' pos='.1 0 0'/><geom size='.1' mass='.7' pos='0 .2 0'/>"
      "<geom type='cylinder' size='.1 .2' euler='30 40 0'/><geom type='ellipsoid' size='.1 .2 .3' euler='0 50 0'/>"
      "<geom type='capsule' size='.1 .2' pos='0 0 .5' euler='20 0 0' density='100'/></body></worldbody>";
  const std::string path = file(inside);
  const MujocoModel mujoco(path);
  Config config;
  config.addFile(path);
  const LinkInertia link = config.inertias().back();
  const double* com = mujoco.model().body_ipos + 3;
  EXPECT_NEAR(link.mass, mujoco.model().body_mass[1], 1e-12);
  EXPECT_TRUE(near(link.com, Vector3d(com[0], com[1], com[2]), 1e-12));
  const double* moments = mujoco.model().body_inertia + 3;
  EXPECT_NEAR(link.matrix.trace(), moments[0] + moments[1] + moments[2], 1e-12);
  EXPECT_NEAR(link.matrix.determinant(), moments[0] * moments[1] * moments[2], 1e-12);
}

TEST_F(MjcfReader, MistakesSayWhereTheyAreAndWhatIsNear) {
  const auto expect = [&](const std::string& inside, std::initializer_list<const char*> parts) {
    expectError<ParseError>([&] { load(inside); }, parts);
  };
  expect("<worldbody><body name='a'/><body name='a'/></worldbody>",
         {"m.xml:2:34", "the body 'a' is already defined at"});
  expect("<worldbody><body><joint type='hing'/></body></worldbody>", {"m.xml:2:25", "similar names: hinge"});
  expect("<worldbody><body><jiont/></body></worldbody>", {"m.xml:2:18: unknown element <jiont>", "joint"});
  expect("<worldbdy/>", {"m.xml:2:1", "worldbody"});
  expect("<worldbody><geom size='a'/></worldbody>", {"m.xml:2:18", "size=\"a\": expected 1 to 3 numbers"});
  expect("<worldbody><geom/></worldbody>", {"m.xml:2:12", "a sphere has a size of 1 number, got 0"});
  expect("<worldbody><body pos='1 2'/></worldbody>", {"m.xml:2:18", "expected 3 numbers"});
  expect("<worldbody><body quat='0 0 0 0'/></worldbody>", {"the quaternion is zero"});
  expect("<worldbody><body euler='0 0 0' quat='1 0 0 0'/></worldbody>", {"both give the rotation"});
  expect("<worldbody><body><joint axis='0 0 0'/></body></worldbody>", {"its axis is zero"});
  expect("<worldbody><body><body><freejoint/></body></body></worldbody>", {"a free joint must be the only one"});
  expect("<worldbody><joint/></worldbody>", {"the world does not move"});
  expect("<worldbody><body><joint class='c'/></body></worldbody>", {"no default class 'c'"});
  expect("<compiler coordinate='global'/>", {"MuJoCo removed 'global'"});
  expect("<default><default class='a'><default class='a'/></default></default>",
         {"the default class 'a' already exists"});
}

TEST_F(MjcfReader, ReferencesToMissingElementsAreLeftOut) {
  const auto expect = [&](const std::string& inside, const char* part) {
    load(inside);
    ASSERT_EQ(warnings_.size(), 1u) << inside;
    EXPECT_NE(warnings_[0].find(part), std::string::npos) << warnings_[0];
  };
  expect("<worldbody><geom type='mesh' mesh='x'/></worldbody><asset><mesh name='xy' vertex='0 0 0'/></asset>",
         "no mesh 'x' in <asset>; the geom has no shape; similar names: xy");
  expect("<contact><exclude body1='world' body2='b'/></contact>", "there is no body 'b'; it is left out");
  expect("<equality><joint joint1='x'/></equality>", "there is no joint 'x'; the element is left out");
  expect("<worldbody><body><joint range='1 -1'/></body></worldbody>", "it is read as unlimited");
  expect("<worldbody><geom size='.1' rgba='1 0 0'/></worldbody>", "the alpha is read as 1");
}

TEST_F(MjcfReader, ReplicatedPartsStandWhereMujocoPutsThem) {
  EXPECT_LT(difference("<compiler eulerseq='zyx'/><worldbody><body name='base' euler='10 20 30'>"
                       "<replicate count='3' offset='1 0 .1' euler='30 10 90' sep='-'>"
                       "<body name='b' pos='0 1 0'><joint name='j'/><geom name='g' size='.1'/></body>"
                       "<replicate count='11' offset='0 1 0'><body name='c'><joint name='k'/><geom size='.1'/></body>"
                       "</replicate></replicate></body></worldbody>"
                       "<contact><exclude body1='base' body2='b'/></contact>"),
            kReaderAgreement);
  const Config config = load(
      "<worldbody><replicate count='11' offset='1 0 0'><replicate count='2' sep='_'><body name='b'/></replicate>"
      "</replicate></worldbody>");
  EXPECT_TRUE(config.findFrame("b_000") &&
              config.findFrame("b_110"));  // the inner number first, as many digits as needed
}

TEST_F(MjcfReader, AttachedModelsKeepTheirSettingsAndStandWhereMujocoPutsThem) {
  write("hand.xml",
        "<mujoco><compiler angle='radian'/><default><joint range='-1 1' axis='1 0 0'/><default class='k'><joint "
        "axis='0 1 0'/></default></default><asset><mesh name='m' vertex='0 0 0 1 0 0 0 1 0 0 0 1'/></asset>"
        "<worldbody><body name='hand' pos='0 0 1' euler='0 1 0'><joint name='j'/><geom name='g' type='mesh' mesh='m' "
        "mass='1'/>"
        "<body name='f' pos='.1 0 0' childclass='k'><joint name='fj'/><geom size='.1'/></body></body></worldbody>"
        "<contact><exclude body1='hand' body2='f'/></contact></mujoco>");
  const std::string scene =
      "<asset><model name='o' file='hand.xml'/></asset><worldbody><body name='a' pos='1 0 0'><joint name='j' range='0 "
      "90'/>"
      "<geom size='.1'/><frame pos='0 2 0' euler='0 0 30'><attach model='o' body='hand' prefix='x_'/></frame>"
      "<attach model='o' prefix='y_'/></body></worldbody><contact><exclude body1='a' body2='x_hand'/></contact>"
      "<keyframe><key name='home' qpos='.1 .2 .3 .4 .5'/></keyframe>";
  EXPECT_LT(difference(scene), kReaderAgreement);
  const Config config = load(scene);
  EXPECT_TRUE(warnings_.empty()) << warnings_[0];
  EXPECT_EQ(config.getJointNames(), (std::vector<std::string>{"j", "x_j", "x_fj", "y_j", "y_fj"}));
  EXPECT_EQ(config.getFrame("x_j").data().joint->upper[0], 1.);
}

TEST_F(MjcfReader, ActuatorsWithoutJointAndRangesOfBallsAreTold) {
  load(
      "<worldbody><body name='a'><joint name='elbow'/><geom size='.1'/></body><body name='b'><joint name='ball' "
      "type='ball' range='0 90'/><geom size='.1'/></body></worldbody><actuator><position joint='elbov'/></actuator>");
  const std::string told = join(warnings_, "\n");
  EXPECT_NE(told.find("<position>: there is no joint 'elbov'; it is left out; similar names: elbow"), std::string::npos)
      << told;
  EXPECT_NE(told.find("the range of a ball joint is not kept"), std::string::npos) << told;
}

TEST_F(MjcfReader, AnAttachedUrdfModelIsLeftOutWithAWarning) {
  write("hand.urdf", "<robot name='h'><link name='hand'/></robot>");
  const Config config = load(
      "<asset><model name='o' file='hand.urdf'/></asset><worldbody><body name='a'><joint name='j'/><geom size='.1'/>"
      "<attach model='o' body='hand' prefix='x_'/></body></worldbody>");
  EXPECT_EQ(config.getJointNames(), std::vector<std::string>{"j"});
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("model 'hand.urdf' is a URDF file, which <attach> does not read; it is left out"),
            std::string::npos)
      << warnings_[0];
}

TEST_F(MjcfReader, AssetsOfIncludedFilesAreFoundAsMujocoFindsThem) {
  const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  std::filesystem::create_directories(folder_ / "sub");
  std::filesystem::create_directories(folder_ / "meshes");
  write("sub/t.obj", tetrahedron);
  write("meshes/u.obj", tetrahedron);
  for (const char* file : {"t.obj", "../meshes/u.obj"}) {
    write("sub/b.xml", "<mujoco><asset><mesh name='t' file='" + std::string(file) +
                           "'/></asset><worldbody><geom name='g' type='mesh' mesh='t'/></worldbody></mujoco>");
    const Config config = load("<include file='sub/b.xml'/><compiler meshdir=''/>");
    EXPECT_EQ(config.getFrame("g").getShapeType(), ShapeType::mesh) << file;
  }
}

TEST_F(MjcfReader, AHeightFieldIsAMeshOfConvexParts) {
  const Config config = load(
      "<asset><hfield name='h' nrow='2' ncol='3' elevation='1 2 3  4 5 9' size='1 2 .5 .1'/></asset>"
      "<worldbody><geom name='g' type='hfield' hfield='h'/></worldbody>");
  const Mesh& mesh = *config.getFrame("g").data().shape->geometry->mesh;
  EXPECT_EQ(mesh.parts.size(), 4u);  // two prisms per cell
  double top = 0., bottom = 0., corner = 0.;
  for (const Vector3d& p : mesh.vertices) {
    top = std::max(top, p.z());
    bottom = std::min(bottom, p.z());
    if (p.x() == 1. && p.y() == 2. && p.z() > 0.) corner = p.z();
  }
  EXPECT_NEAR(top, .5, 1e-12);  // 9, in the last row, which has the smallest y
  EXPECT_NEAR(bottom, -.1, 1e-12);
  EXPECT_NEAR(corner, .5 * (3. - 1.) / 8., 1e-12);
}

TEST_F(MjcfReader, OneWarningListsTheIgnoredElements) {
  load(
      "<worldbody><body><joint name='j'/></body></worldbody><actuator><motor joint='j'/><motor tendon='t'/><motor "
      "tendon='t'/></actuator>"
      "<sensor><jointpos joint='j'/></sensor>");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("ignored elements: actuator/motor (2), sensor/jointpos (1)"), std::string::npos)
      << warnings_[0];
}

TEST_F(MjcfReader, ATextThatIsNotUtf8IsReadWithAWarning) {
  const Config config = world("<body name='Jos\xE9'/>");
  EXPECT_EQ(config.getFrameNames().back(), "Jos?");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("not UTF-8; 1 byte of it is read as '?'"), std::string::npos) << warnings_[0];
}

TEST_F(MjcfReader, AnXmlFileWhoseRootIsRobotIsUrdf) {
  Config config;
  config.addFile(write("r.xml", "<?xml version='1.0'?>\n<!-- <mujoco> --><robot><link name='a'/></robot>"));
  EXPECT_EQ(config.getFrameNames(), std::vector<std::string>{"a"});
  expectError<ParseError>([&] { Config().addFile(write("s.xml", "<sdf/>")); },
                          {"s.xml:1:1", "<mujoco>", "<robot>", "not <sdf>"});
}
