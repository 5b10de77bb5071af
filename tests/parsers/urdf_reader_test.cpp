#include "kinegraph/parsers/urdf/urdf_reader.h"

#include <gtest/gtest.h>

#include <limits>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "kinegraph/scene/config.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

/// A scene read from a URDF text, through a file as users do it.
class UrdfReader : public ::testing::Test {
 protected:
  Config load(const std::string& inside) {
    std::ofstream(folder_ / "r.urdf") << "<robot name='r'>\n" << inside << "\n</robot>";
    Config config;
    config.addFile((folder_ / "r.urdf").string());
    return config;
  }

  /// Returns the warnings of loading, without the folder.
  std::string messageOf(const std::string& inside) {
    try {
      load(inside);
    } catch (const ParseError& error) {
      const std::string message = error.what(), folder = folder_.path().string() + "/";
      EXPECT_TRUE(message.starts_with(folder)) << message;
      return message.substr(folder.size());
    }
    return "no error";
  }

  static std::string joint(const char* type, const char* more) {
    return std::string("<link name='a'/><link name='b'/><joint name='j' type='") + type +
           "'><parent link='a'/><child link='b'/>" + more + "</joint>";
  }

  TemporaryFolder folder_;
};

void expectPosition(const Config& config, const char* frame, double x, double y, double z) {
  EXPECT_LT((config.getFrame(frame).getPose().p - Vector3d(x, y, z)).norm(), 1e-12)
      << frame << " is at " << config.getFrame(frame).getPose().p.transpose();
}

}  // namespace

TEST_F(UrdfReader, FramesAreNamedAfterLinksAndJoints) {
  const Config config = load(joint(
      "revolute", "<origin xyz='1 0 0'/><axis xyz='0 0 1'/><limit lower='-1' upper='2' effort='5' velocity='3'/>"));
  EXPECT_EQ(config.getFrameNames(), (std::vector<std::string>{"a", "j_origin", "j", "b"}));
  EXPECT_EQ(config.getJointNames(), std::vector<std::string>{"j"});
  EXPECT_EQ(config.getFrame("j").getJointType(), JointType::hingeZ);
  EXPECT_EQ(config.getJointLimits(), (MatrixXd(2, 1) << -1, 2).finished());
  EXPECT_EQ(config.getFrame("j").attributes().find("ctrl_limits")->value.as<NumberArray>()->numbers,
            (std::vector<double>{3., 5., -1.}));
}

TEST_F(UrdfReader, InfiniteLimitsAreNone) {
  Config config = load(joint("revolute", "<limit lower='-inf' upper='inf' effort='inf' velocity='+inf'/>"));
  EXPECT_EQ(
      config.getJointLimits(),
      (MatrixXd(2, 1) << -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()).finished());
  EXPECT_EQ(config.getFrame("j").attributes().find("ctrl_limits"), nullptr);
  config = load(joint("prismatic", "<axis xyz='1 0 0'/><limit lower='0' upper='inf'/>"));
  EXPECT_EQ(config.getJointLimits()(0, 0), 0.);
  EXPECT_GE(config.getJointLimits()(1, 0), 1e9);
}

TEST_F(UrdfReader, AJointNamedAsALinkGetsASuffix) {
  const Config config = load(
      "<link name='a'/><link name='b'/><joint name='b' type='continuous'><parent link='a'/><child link='b'/></joint>");
  EXPECT_EQ(config.getFrameNames(), (std::vector<std::string>{"a", "b_joint", "b"}));
}

TEST_F(UrdfReader, RollPitchYawRotatesAboutFixedAxes) {
  const Config config = load(joint("fixed", "<origin rpy='0.1 0.2 0.3'/>"));
  const Matrix3d expected = axisRotation(2, .3) * axisRotation(1, .2) * axisRotation(0, .1);
  EXPECT_LT((config.getFrame("b").getPose().transform().R - expected).norm(), 1e-14);
}

TEST_F(UrdfReader, APrismaticJointSlidesAlongAnyAxis) {
  for (const auto& [axis, direction] : {std::pair("1 0 0", Vector3d(1, 0, 0)), std::pair("0 -1 0", Vector3d(0, -1, 0)),
                                        std::pair("3 0 4", Vector3d(.6, 0, .8))}) {
    Config config = load(
        joint("prismatic",
              (std::string("<origin xyz='1 2 3'/><axis xyz='") + axis + "'/><limit lower='0' upper='1'/>").c_str()));
    config.setJointState(VectorXd::Constant(1, .5));
    const Pose b = config.getFrame("b").getPose();
    EXPECT_LT((b.p - Vector3d(1, 2, 3) - .5 * direction).norm(), 1e-14) << axis;
    EXPECT_LT((b.transform().R - Matrix3d::Identity()).norm(), 1e-14) << axis;
  }
}

TEST_F(UrdfReader, APlanarJointMovesAcrossItsAxis) {
  Config config = load(joint("planar", "<axis xyz='1 0 0'/>"));
  config.setJointState(Vector3d(.3, .4, .5));
  const Pose b = config.getFrame("b").getPose();
  EXPECT_NEAR(b.p[0], 0., 1e-15);
  EXPECT_NEAR(b.p.norm(), .5, 1e-14);
  EXPECT_LT((b.transform().R - axisRotation(0, .5)).norm(), 1e-14);
}

TEST_F(UrdfReader, AFloatingJointIsFree) {
  EXPECT_EQ(load(joint("floating", "")).getFrame("j").getJointType(), JointType::free);
}

TEST_F(UrdfReader, MimicsFollowWithMultiplierAndOffsetThroughOthers) {
  const auto next = [](const char* name, const char* parent, const char* more) {
    return std::string("<link name='l_") + name + "'/><joint name='" + name + "' type='revolute'><parent link='" +
           parent + "'/><child link='l_" + name + "'/>" + more + "<limit lower='-3' upper='3'/></joint>";
  };
  Config config =
      load("<link name='a'/>" + next("c", "a", "<axis xyz='0 -1 0'/><mimic joint='d' multiplier='-2' offset='.1'/>") +
           next("d", "a", "<axis xyz='0 0 1'/><mimic joint='e' multiplier='.5' offset='.2'/>") + next("e", "a", ""));
  EXPECT_EQ(config.getJointNames(), std::vector<std::string>{"e"});
  config.setJointState(VectorXd::Constant(1, .4));
  const double d = .5 * .4 + .2, c = -2. * d + .1;
  EXPECT_LT((config.getFrame("l_d").getPose().transform().R - axisRotation(2, d)).norm(), 1e-14);
  EXPECT_LT((config.getFrame("l_c").getPose().transform().R - axisRotation(1, -c)).norm(), 1e-14);
}

TEST_F(UrdfReader, AMimicFollowsASourceThatSlidesBackwards) {
  Config config = load(joint("prismatic", "<axis xyz='-1 0 0'/><limit lower='0' upper='1'/>") +
                       "<link name='c'/><joint name='m' type='prismatic'><parent link='a'/><child link='c'/>"
                       "<axis xyz='0 1 0'/><limit lower='0' upper='1'/><mimic joint='j' multiplier='2'/></joint>");
  config.setJointState(VectorXd::Constant(1, .25));
  expectPosition(config, "b", -.25, 0, 0);
  expectPosition(config, "c", 0, .5, 0);
}

TEST_F(UrdfReader, AMimicOfNothingIsIndependentAndOneOfAFixedJointIsFixed) {
  Config config = load(joint("continuous", "<mimic joint='nothing'/>") +
                       "<link name='c'/><joint name='f' type='fixed'><parent link='b'/><child link='c'/></joint>"
                       "<link name='d'/><joint name='m' type='prismatic'><parent link='c'/><child link='d'/>"
                       "<limit lower='0' upper='1'/><mimic joint='f' multiplier='3' offset='.5'/></joint>");
  EXPECT_EQ(config.getJointNames(), std::vector<std::string>{"j"});
  expectPosition(config, "d", .5, 0, 0);
  const std::vector<std::string> warnings = config.takeWarnings();
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("joint 'j' mimics 'nothing', which is not a joint"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find("joint 'm' mimics 'f', which is fixed"), std::string::npos) << warnings[1];
}

TEST_F(UrdfReader, AJointThatMimicsItselfIsIndependent) {
  const Config config = load(joint("continuous", "<mimic joint='j'/>"));
  EXPECT_EQ(config.getJointDimension(), 1);
  ASSERT_EQ(config.fileWarnings().size(), 1u);
  EXPECT_NE(config.fileWarnings()[0].find("joint 'j' mimics itself; it is read as an independent joint"),
            std::string::npos);
}

TEST_F(UrdfReader, ALinkCarriesItsInertiaInItsOwnAxes) {
  const Config config = load(
      "<link name='a'><inertial><origin xyz='.1 .2 .3' rpy='0 0 1.5707963267948966'/><mass value='2'/>"
      "<inertia ixx='1' iyy='2' izz='3' ixy='0' ixz='0' iyz='0'/></inertial></link>");
  const Inertia inertia = config.getFrame("a").getInertia().value();
  EXPECT_EQ(inertia.mass, 2.);
  EXPECT_EQ(inertia.com, Vector3d(.1, .2, .3));
  EXPECT_LT((inertia.matrix - Matrix3d(Vector3d(2, 1, 3).asDiagonal())).norm(), 1e-12);
}

TEST_F(UrdfReader, ShapesAreChildFramesWithColorsAndContacts) {
  const Config config = load(
      "<material name='blue'><color rgba='0 0 1 1'/></material>"
      "<link name='a'>"
      "<visual><origin xyz='0 0 1'/><geometry><cylinder length='2' radius='.1'/></geometry><material "
      "name='blue'/></visual>"
      "<visual><geometry><sphere radius='.5'/></geometry></visual>"
      "<collision><geometry><box size='1 2 3'/></geometry></collision></link>");
  EXPECT_EQ(config.getFrameNames(), (std::vector<std::string>{"a", "a_0", "a_1", "a_2"}));
  expectPosition(config, "a_0", 0, 0, 1);
  EXPECT_EQ(config.getFrame("a_0").getSize(), (std::vector<double>{2., .1}));
  EXPECT_EQ(config.getFrame("a_0").data().shape->color.value(), Vector4d(0, 0, 1, 1));
  EXPECT_EQ(config.getFrame("a_0").data().shape->contact, 0);
  EXPECT_EQ(config.getFrame("a_1").getShapeType(), ShapeType::sphere);
  EXPECT_EQ(config.getFrame("a_2").getSize(), (std::vector<double>{1., 2., 3.}));
  EXPECT_EQ(config.getFrame("a_2").data().shape->contact, -2);
}

TEST_F(UrdfReader, MeshesOfPackagesAreFoundAboveTheFile) {
  std::filesystem::create_directories(folder_ / "meshes");
  std::ofstream(folder_ / "meshes" / "t.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(folder_ / "package.xml") << "<package><name>my_robot</name></package>";
  for (const std::string& file : {std::string("meshes/t.obj"), std::string("package://my_robot/meshes/t.obj"),
                                  "package://" + folder_.path().filename().string() + "/meshes/t.obj"}) {
    const Config config = load("<link name='a'><visual><geometry><mesh filename='" + file +
                               "' scale='1 2 3'/></geometry></visual></link>");
    ASSERT_TRUE(config.getFrame("a_0").data().shape) << file;
    const Mesh& mesh = *config.getFrame("a_0").data().shape->geometry->mesh;
    ASSERT_EQ(mesh.vertices.size(), 3u);
    EXPECT_EQ(mesh.vertices[0] + mesh.vertices[1] + mesh.vertices[2], Vector3d(1, 2, 0));
  }
}

TEST_F(UrdfReader, AColladaMeshIsNotRotatedByItsUpAxis) {
  std::ofstream(folder_ / "t.dae")
      << "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>"
         "<asset><unit meter='1'/><up_axis>Z_UP</up_axis></asset><library_geometries><geometry id='g'><mesh>"
         "<source id='p'><float_array id='a' count='9'>0 0 0 1 0 0 0 0 2</float_array><technique_common>"
         "<accessor source='#a' count='3' stride='3'><param name='X' type='float'/><param name='Y' type='float'/>"
         "<param name='Z' type='float'/></accessor></technique_common></source>"
         "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices>"
         "<triangles count='1'><input semantic='VERTEX' source='#v' offset='0'/><p>0 1 2</p></triangles>"
         "</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id='s'><node id='n'>"
         "<instance_geometry url='#g'/></node></visual_scene></library_visual_scenes>"
         "<scene><instance_visual_scene url='#s'/></scene></COLLADA>";
  const Config config = load("<link name='a'><visual><geometry><mesh filename='t.dae'/></geometry></visual></link>");
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : config.getFrame("a_0").data().shape->geometry->mesh->vertices) sum += p;
  EXPECT_EQ(sum, Vector3d(1, 0, 2));
}

TEST_F(UrdfReader, AMissingMeshIsAWarningAndLeavesTheFrame) {
  Config config =
      load("<link name='a'><visual><geometry><mesh filename='package://nowhere/a.stl'/></geometry></visual></link>");
  EXPECT_FALSE(config.getFrame("a_0").data().shape);
  const std::vector<std::string> warnings = config.takeWarnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("r.urdf:2:34: link 'a': mesh 'package://nowhere/a.stl' does not exist"), std::string::npos)
      << warnings[0];
}

TEST_F(UrdfReader, AGFileIncludesAndEditsARobot) {
  load(joint("continuous", ""));
  std::ofstream(folder_ / "scene.g")
      << "world: {}\nPrefix: l_\nInclude: <r.urdf>\nEdit l_a(world): { pose: [1 0 0] }\n";
  Config config;
  config.addFile((folder_ / "scene.g").string());
  EXPECT_EQ(config.getFrameNames(), (std::vector<std::string>{"world", "l_a", "l_j", "l_b"}));
  expectPosition(config, "l_b", 1, 0, 0);
}

TEST_F(UrdfReader, MistakesAreReportedWithTheirPlacesAllAtOnce) {
  const std::string message = messageOf(
      "<link name='a'/>\n"
      "<link name='a'/>\n"
      "<joint name='j' type='revolut'>\n"
      "  <parent link='a'/><child link='b'/>\n"
      "  <origin xyz='1 2'/>\n"
      "</joint>");
  EXPECT_NE(message.find("r.urdf:3:1: link 'a' is already defined at "), std::string::npos) << message;
  EXPECT_NE(message.find("r.urdf:4:17: joint 'j': unknown joint type 'revolut'; expected one of "), std::string::npos)
      << message;
  EXPECT_NE(message.find("r.urdf:6:11: joint 'j': <origin> xyz=\"1 2\": expected 3 numbers"), std::string::npos)
      << message;
}

TEST_F(UrdfReader, WhatIsNoTreeIsRefused) {
  const auto fixed = [](const char* name, const char* parent, const char* child) {
    return std::string("<joint name='") + name + "' type='fixed'><parent link='" + parent + "'/><child link='" + child +
           "'/></joint>\n";
  };
  const std::string links = "<link name='hand'/><link name='arm'/><link name='base'/>\n";
  EXPECT_NE(messageOf(links + fixed("j", "base", "hnd")).find("no link 'hnd'; similar names: hand"), std::string::npos);
  EXPECT_NE(messageOf(links + fixed("j", "base", "arm") + fixed("k", "hand", "arm"))
                .find("link 'arm' is the child of two joints: 'j' and 'k'"),
            std::string::npos);
  EXPECT_NE(messageOf(links + fixed("j", "hand", "arm") + fixed("k", "arm", "hand")).find("form a loop"),
            std::string::npos);
}

TEST_F(UrdfReader, AMistakeInAValueIsReportedWhereItStands) {
  EXPECT_EQ(messageOf("<link name='a'/><link name='b'/>\n<joint name='j' type='fixed'><parent link='a'/>"
                      "<child link='b'/><origin rpy='1 2'/></joint>")
                .substr(0, 22),
            "r.urdf:3:73: joint 'j'");
}

TEST_F(UrdfReader, AFlawOfAShapeLeavesItOut) {
  for (const char* shape : {"<ellipsoid radius='1'/>", "<box size='1 1'/>", "<box/>", "<sphere radius='-1'/>",
                            "<mesh filename='t.obj' scale='0 0 0'/>", ""}) {
    for (const std::string element : {"visual", "collision"}) {
      Config config =
          load("<link name='a'><" + element + "><geometry>" + shape + "</geometry></" + element + "></link>");
      EXPECT_EQ(config.getFrameNames(), std::vector<std::string>{"a"}) << shape;
      ASSERT_EQ(config.fileWarnings().size(), 1u) << shape;
      EXPECT_NE(config.fileWarnings()[0].find("the <" + element + "> is left out"), std::string::npos) << shape;
    }
  }
}

TEST_F(UrdfReader, AMeshThatCannotBeReadIsAWarning) {
  for (const char* text : {"", "solid a\nendsolid a\n", "version https://git-lfs.github.com/spec/v1\noid sha256:0\n"}) {
    folder_.write("t.stl", text);
    Config config = load("<link name='a'><collision><geometry><mesh filename='t.stl'/></geometry></collision></link>");
    EXPECT_FALSE(config.getFrame("a_0").data().shape);
    ASSERT_EQ(config.fileWarnings().size(), 1u) << text;
    EXPECT_NE(config.fileWarnings()[0].find("r.urdf:2:37: link 'a': mesh file"), std::string::npos);
  }
}

TEST_F(UrdfReader, ColorsOfThreeOrFiveNumbersAreRead) {
  for (const char* rgba : {".1 .2 .3", ".1 .2 .3 1 .5"}) {
    Config config =
        load("<link name='a'><visual><geometry><sphere radius='1'/></geometry><material name='m'><color rgba='" +
             std::string(rgba) + "'/></material></visual></link>");
    EXPECT_EQ(config.getFrame("a_0").data().shape->color, Vector4d(.1, .2, .3, 1.));
    EXPECT_EQ(config.fileWarnings().size(), 1u);
  }
}

TEST_F(UrdfReader, ReversedLimitsAreNoneAndEqualOnesLock) {
  Config config = load(joint("revolute", "<limit lower='1' upper='-1' effort='1' velocity='1'/>"));
  EXPECT_EQ(config.getFrame("j").data().joint->lower.size(), 0);
  EXPECT_NE(config.fileWarnings().at(0).find("is above its upper limit -1; it is read as unlimited"),
            std::string::npos);
  config = load(joint("prismatic", "<limit lower='.5' upper='.5' effort='1' velocity='1'/>"));
  EXPECT_EQ(config.getJointState(), VectorXd{{.5}});
  EXPECT_EQ(config.getFrame("j").data().joint->lower[0], .5);
  EXPECT_EQ(config.getFrame("j").data().joint->upper[0], .5);
  EXPECT_NE(config.fileWarnings().at(0).find("the joint cannot move"), std::string::npos);
}

TEST_F(UrdfReader, StrictReadingRefusesWhatIsMended) {
  load(joint("revolute", "<limit lower='1' upper='-1'/>"));
  FileOptions strict;
  strict.strict = true;
  Config config;
  EXPECT_THROW(config.addFile((folder_ / "r.urdf").string(), "", strict), ParseError);
  EXPECT_EQ(config.getFrameDimension(), 0);
}

TEST_F(UrdfReader, AQuaternionGivesTheRotation) {
  const Config config = load(joint("fixed", "<origin xyz='0 0 1' quat_xyzw='0 0.6 0 0.8'/>"));
  const Quaterniond q = config.getFrame("b").getPose().q;
  EXPECT_NEAR(std::abs(q.dot(Quaterniond(.8, 0., .6, 0.))), 1., 1e-12);
}

TEST_F(UrdfReader, AMimicOfMultiplierZeroFixesTheJoint) {
  Config config = load(
      "<link name='a'/><link name='b'/><link name='c'/>"
      "<joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint>"
      "<joint name='k' type='continuous'><parent link='b'/><child link='c'/><mimic joint='j' multiplier='0' "
      "offset='.5'/></joint>");
  EXPECT_EQ(config.getJointDimension(), 1);
  EXPECT_NEAR(config.getFrame("c").getPose().q.x(), std::sin(.25), 1e-12);
  EXPECT_EQ(config.fileWarnings().size(), 1u);
}

TEST_F(UrdfReader, FurtherRootsAreReadWithAWarning) {
  const Config config = load("<link name='hand'/><link name='arm'/>");
  EXPECT_EQ(config.getFrameNames(), (std::vector<std::string>{"hand", "arm"}));
  EXPECT_EQ(config.fileWarnings().size(), 1u);
}

TEST_F(UrdfReader, TheWarningsOfAnSrdfFileBesideItAreToldAsThoseOfItsOwnFile) {
  folder_.write("r.srdf", "<robot name='r'>\n<disable_collisions link1='a' link2='l7'/></robot>");
  const Config config = load("<link name='a'/>");
  ASSERT_EQ(config.fileWarnings().size(), 1u);
  EXPECT_NE(config.fileWarnings()[0].find("r.srdf:2:1: the scene has no link 'l7'"), std::string::npos);
}

TEST_F(UrdfReader, MacrosNeedAnExpander) {
  const std::string path = folder_.write("arm.urdf.xacro", "<robot/>");
  try {
    Config().addFile(path);
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("xacrodoc " + path + " -o robot.urdf"), std::string::npos);
  }
  setXacroExpander([](const std::string&, const XacroArguments& arguments) {
    return "<robot><link name='" + arguments.at("name") + "'/></robot>";
  });
  FileOptions options;
  options.xacro = {{"name", "ur5e"}};
  Config config;
  config.addFile(path, "", options);
  setXacroExpander({});
  EXPECT_EQ(config.getFrameNames(), std::vector<std::string>{"ur5e"});
}
