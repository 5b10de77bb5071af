#include "kinegraph/scene/loading/reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/scene/config.h"
#include "tests/support/scene.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

std::string messageOf(const char* text) {
  Config config;
  config.addText("before: {}");
  try {
    config.addText(text, "s.g");
  } catch (const ParseError& error) {
    EXPECT_EQ(config.getFrameDimension(), 1) << "a scene that fails leaves the configuration as it was";
    return error.what();
  }
  return "no error";
}

void expectMessage(const char* text, const char* part) {
  const std::string message = messageOf(text);
  EXPECT_NE(message.find(part), std::string::npos) << text << "\n-> " << message << "\nexpected: " << part;
}

constexpr const char* kTutorialArm = R"g(
zero { X:"T t(0 0 0) d(180 0 0 1)" shape:sphere mass=1 size=[0.
0. .2 .05]}
link1 { shape:capsule mass=1 size=[0. 0. .3 .05] color: [0 0
1]}
(zero link1) { joint:hingeX, pre:"T t(0 0 .00)" B:"T t(0 0 .2)" }
link2      { shape:capsule mass=1 size=[0. 0. .3 .05] color: [1 0
0]}
(link1 link2) { joint:hingeX, pre:"T t(0 0.0 .15)" B:"T t(0 0.0
.15)" }
endeffector  { shape:sphere mass=1 size=[0. 0. .2 .05] color:
[0 1 0]}
(link2 endeffector) { joint:hingeX, pre:"T t(0 0.0 .18)" B:"T t(0
0.0 .0)" }
)g";

}  // namespace

TEST(ParsePose, GivesTheRecordedPoses) {
  const auto expectPose = [](const char* text, std::vector<double> numbers, double tolerance = 5e-6) {
    const Vector7d pose = parsePose(text).numbers();
    for (int i = 0; i < 7; ++i) EXPECT_NEAR(pose[i], numbers[i], tolerance) << text << " entry " << i;
  };
  const double h = std::sqrt(.5);
  expectPose("t(1 0 0) d(90 0 0 1) t(1 0 0)", {1, 1, 0, h, 0, 0, h});
  expectPose("d(90 0 0 1) t(1 0 0)", {0, 1, 0, h, 0, 0, h});
  expectPose("E(.1 .2 .3)", {0, 0, 0, .98186, .06407, .09116, .15344});
  expectPose("d(-30 1 0 0)", {0, 0, 0, .96593, -.25882, 0, 0});
  expectPose("T t(1,2,3)", {1, 2, 3, 1, 0, 0, 0});
  expectPose("q(1 1 0 0)", {0, 0, 0, h, h, 0, 0});
  expectPose("<1 2 3 1 0 0 0>", {1, 2, 3, 1, 0, 0, 0});
  expectPose("", {0, 0, 0, 1, 0, 0, 0});
}

TEST(ParsePose, ExplainsMistakes) {
  for (const char* text : {"t(1 2)", "x(1 2 3)", "t(1 2 3", "t 1 2 3", "q(0 0 0 0)", "1 2 3 4 5", "t(1 2 3) 7"}) {
    EXPECT_THROW(parsePose(text), ParseError) << text;
  }
}

TEST(Reader, TheTutorialArmIsThatOfTheText) {
  Config arm = scene(kTutorialArm);
  ASSERT_EQ(arm.getJointDimension(), 3);
  EXPECT_EQ(arm.getFrame("link1").getSize(), (std::vector<double>{.3, .05}));
  EXPECT_EQ(arm.getFrame("zero").getSize(), std::vector<double>{.05});
  EXPECT_NEAR(arm.getFrame("endeffector").getPose().p.z(), .68, 1e-12);
  arm.setJointState(Vector3d(.3, .4, .5));
  const Pose tip = arm.getFrame("endeffector").getPose();
  EXPECT_LT((tip.p - Vector3d(0, 0.31602391, 0.58676569)).norm(), 1e-8);
  EXPECT_LT((arm.getFrame("link2").getPose().p - Vector3d(0, 0.20006473, 0.44909410)).norm(), 1e-8);
  EXPECT_LT((wxyz(tip.q).cwiseAbs() - Vector4d(0, 0, 0.56464247, 0.82533561)).norm(), 1e-8);
}

TEST(Reader, OnePostTransformMakesAJointFrameOfItsOwn) {
  Config config = scene("a: {} b(a): { joint: hingeZ, pre: \"t(1 0 0)\", post: \"t(0 1 0)\" } c(b): {}");
  EXPECT_EQ(config.getFrameNames(), (std::vector<std::string>{"a", "b", "c", "|b", "|b_origin"}));
  config.setJointState(VectorXd::Constant(1, M_PI / 2));
  EXPECT_LT((config.getFrame("b").getPose().p - Vector3d(0, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(config.getFrame("c").getParent()->getName(), "b");
}

TEST(Reader, AcceptsForwardReferencesAndPosesOfAllSpellings) {
  Config config =
      scene(R"g(b(a): { Q: [1 0 0] }  a: { X: <t(0 0 1)> }  c(a): { rel: "t(0 1 0)" }  d(a): { pose: [0 0 2] }
      e(a): { X: [0 0 5] })g");
  EXPECT_LT((config.getFrame("b").getPose().p - Vector3d(1, 0, 1)).norm(), 1e-15);
  EXPECT_LT((config.getFrame("c").getPose().p - Vector3d(0, 1, 1)).norm(), 1e-15);
  EXPECT_LT((config.getFrame("d").getPose().p - Vector3d(0, 0, 3)).norm(), 1e-15);
  EXPECT_LT((config.getFrame("e").getRelativePose().p - Vector3d(0, 0, 4)).norm(), 1e-15);
}

TEST(Reader, MimicJointsFollowWithAnyScale) {
  Config config =
      scene(R"g(a: {} j(a): { joint: transX, limits: [0 1] } k(a): { joint: transX, joint_scale: -2, mimic: (j) })g");
  ASSERT_EQ(config.getJointDimension(), 1);
  config.setJointState(VectorXd::Constant(1, .3));
  EXPECT_NEAR(config.getFrame("k").getPose().p.x(), -.6, 1e-15);
  EXPECT_EQ(config.getJointNames(), std::vector<std::string>{"j"});
}

TEST(Reader, MimicScalesMultiplyTheScaleOfTheirSource) {
  Config config =
      scene(R"g(a: {} j(a): { joint: transX, joint_scale: -1 } k(a): { joint: transX, joint_scale: -1, mimic: j }
      l(a): { joint: transX, joint_scale: 3, mimic: k })g");
  config.setJointState(VectorXd::Constant(1, .3));
  for (const auto& [name, x] : {std::pair{"j", -.3}, {"k", .3}, {"l", -.9}}) {
    EXPECT_NEAR(config.getFrame(name).getPose().p.x(), x, 1e-15) << name;
    EXPECT_NEAR(config.getFrame(name).data().worldPose().p.x(), x, 1e-15) << name;
  }
}

TEST(Reader, IncludesEditsAndPrefixesAreCarriedOut) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sub");
  std::ofstream(folder / "sub" / "arm.g")
      << "base: {}\n link(base): { joint: hingeZ, q: .5 }\n tip(link): { mimic_shape: base }";
  std::ofstream(folder / "scene.g")
      << "Edit l_link: { joint: hingeX }\n Prefix: l_\n Include: <sub/arm.g>\n"
         "Prefix: r_\n Include <sub/arm.g>\n Delete: r_tip\n world: {}\n Edit r_base (world): {}";
  Config config;
  config.addFile((folder / "scene.g").string(), "x_");
  EXPECT_EQ(config.getFrameNames(),
            (std::vector<std::string>{"x_l_base", "x_l_link", "x_l_tip", "x_r_base", "x_r_link", "x_world"}));
  EXPECT_EQ(config.getFrame("x_l_link").getJointType(), JointType::hingeX);
  EXPECT_EQ(config.getFrame("x_r_base").getParent()->getName(), "x_world");
  EXPECT_EQ(config.getFrame("x_r_link").getParent()->getName(), "x_r_base");
}

TEST(Reader, ErrorsNameThePlaceTheFrameAndTheNearestWord) {
  expectMessage("\n\na: { shape: bax, size: [1 1 1] }", "s.g:3:13: frame 'a', shape: unknown shape type 'bax'");
  expectMessage("a: { shape: bax, size: [1 1 1] }", "similar names: box");
  expectMessage("a: {} b(a): { joint: hingZ }", "similar names: hingeZ");
  expectMessage("table: {} b(tabel): {}", "similar names: table");
  expectMessage("a: { shape: box, size: [1 1] }", "size of a box has 3 numbers [x y z], not 2");
  expectMessage("a: { X: \"t(1 2)\" }", "'t' takes 3 numbers");
  expectMessage("a: { joint: hingeX }", "without a parent cannot have a joint");
  expectMessage("a: {} b(a): { joint: hingeX, limits: [1 -1] }", "the lower limit 1 is above the upper limit -1");
  expectMessage("a: {} b(a): { joint: hingeX, mimic: a }", "'a' has no joint");
  expectMessage("a(b): {} b(a): {}", "one of its descendants");
  expectMessage("a: { shape: box, size: [1 1 1] ", "no error");
  expectMessage("a: 3", "expected a frame 'name (parent)");
  expectMessage("Include: <nope.g>", "scene file");
  expectMessage("a: { shape: box, color: red, size: [1 1 1] }", "expected numbers [r g b] in 0..1, got the text 'red'");
  const std::string several = messageOf("a: { shape: bax }\nb: { shape: spher }");
  EXPECT_NE(several.find("s.g:1:"), std::string::npos);
  EXPECT_NE(several.find("s.g:2:"), std::string::npos);
}

TEST(Reader, MisspeltAttributesAreWarnedOf) {
  Config config = scene("a: { shape: box, size: [1 1 1], colour: [1 0 0], note: 3 }");
  const auto warnings = config.takeWarnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("did you mean 'color'"), std::string::npos) << warnings[0];
  EXPECT_TRUE(config.takeWarnings().empty());
}

namespace {

std::vector<std::string> warningsOf(const char* text) {
  Config config;
  config.addText(text, "s.g");
  return config.takeWarnings();
}

}  // namespace

TEST(Reader, MistakesOfAllFilesAreReportedTogether) {
  const TemporaryFolder folder;
  folder.write("part.g", "p: { x: 1.2.3 }\n q: { y: 0x1 }");
  const std::string path = folder.write("scene.g", "Include: <part.g>\na: { z: \"open }\n");
  try {
    Config().addFile(path);
    FAIL();
  } catch (const ParseError& error) {
    const std::string message = error.what();
    for (const char* part : {"part.g:1:9: '1.2.3'", "part.g:2:10: '0x1'", "scene.g:2:9: this \" is never closed"}) {
      EXPECT_NE(message.find(part), std::string::npos) << part << " in\n" << message;
    }
  }
}

TEST(Reader, OneMistakeDoesNotMakeOthersAppear) {
  const std::string message = messageOf("a: {} b(c): { joint: hingeX, Q: [0 0 1] }");
  EXPECT_EQ(message,
            "s.g:1:7: parent of 'b': 'c' is not a frame of this scene\n    a: {} b(c): { joint: hingeX, Q: [0 0 1] }\n "
            "         ^");
}

TEST(Reader, MoreMistakesAreExplained) {
  expectMessage("inclde: <f.g>", "similar names: Include");
  expectMessage("Include: 3", "Include takes a file: 'Include: <path>', not the number 3");
  expectMessage("Delete: 3", "Delete takes the name of a frame");
  expectMessage("a: {} b(a): { joint: generic }", "'_xyc' moves along x, then y, then rotates about z");
  expectMessage("a: {} b(a): { joint: _xyd }", "'d' is not one of x y z a b c");
  expectMessage("a: {} b(a): { joint: 99 }", "joint type 99 does not exist");
  expectMessage("a: { shape: 99 }", "shape type 99 does not exist");
  expectMessage("a: {} b(a): { joint: hingeX, axis: [1 0 0] }", "only a joint of type hinge has an axis");
  expectMessage("a: {} b(a): { joint: free, q: [1 2] }", "a free joint has 7 dofs, got 2 numbers");
  expectMessage("a: {} b(a): { joint: free, q: [0 0 0 0 0 0 0] }", "quaternion in it is zero");
  expectMessage("a: {} b(a): { joint: transXY, limits: [0 1] }", "4 limits (all lower, then all upper), got 2");
  expectMessage("a: { Q: [1 0 0] }", "a frame without a parent has no relative pose");
  expectMessage("a: { pose: [1 2] }", "frame 'a', pose:");
  expectMessage("a: { mass: heavy }", "expected a number, got the text 'heavy'");
  expectMessage("a: { mass: 1, inertia: [1 2] }", "expected 3 (diagonal), 6 (xx xy xz yy yz zz) or 9 numbers, got 2");
  expectMessage("a: { shape: box, size: [1 -1 1] }", "entry -1");
  expectMessage("a: { shape: mesh, mesh: <nope.ply> }", "does not exist");
  expectMessage("a: { shape: sphere, size: [1], color: [1 2 3 4 5] }", "expected 1 (gray), 2 (gray alpha)");
  expectMessage("a: {} b: {} (a b c): {}", "has 3 parents");
  expectMessage("a: {} b(a): {} (b a): { joint: hingeX }", "one of its descendants");
  expectMessage("a: {} b(a): { joint: hingeX, mimic: c } c(a): { joint: hingeX, mimic: b }", "does not mimic this one");
  expectMessage("a: {} b(a): { joint: hingeX } q: [1 2]", "q has 2 numbers; the scene has 1 active dofs");
  expectMessage("a: { mesh_rope: [1 0 0 1e9], shape: lines }", "n from 1 to 10000");
}

TEST(Reader, SuspiciousEntriesCauseWarnings) {
  const auto expectWarning = [](const char* text, const char* part) {
    const auto warnings = warningsOf(text);
    ASSERT_EQ(warnings.size(), 1u) << text;
    EXPECT_NE(warnings[0].find(part), std::string::npos) << warnings[0];
  };
  expectWarning("a: { shpae: 3 }", "s.g:1:6: frame 'a': unknown attribute 'shpae'; did you mean 'shape'?");
  expectWarning("a: { joints: 3 }", "did you mean 'joint'");
  expectWarning("a: { Mass: 3 }", "did you mean 'mass'");
  expectWarning("a: { contact: 1 }", "'contact' has no effect without a shape");
  expectWarning("a: {} a: {}", "a frame named 'a' already exists");
  expectWarning("edit a: {}", "did you mean 'Edit'?");
  expectWarning("Edit tabel: {} table: {}", "no frame 'tabel'; similar names: table");
  expectWarning("Delete: a", "no frame 'a' before this line");
  expectWarning("Quit", "no effect");
  expectWarning("a: {} b(a): { joint: hingeX, to: [1 0 0] }", "write 'post'");
  expectWarning("a: {} b(a): { joint: hingeX, Q: [1 0 0] }", "a constant offset belongs in 'pre'");
  expectWarning("a: { shape: ssBox, size: [.01 1 1 .02] }", "enlarged");
  EXPECT_TRUE(warningsOf("a: { note: 3, mj_damping: 2, x: 1 } b(c): {} c: {} Edit a: {} Delete: a").empty());
}

TEST(Reader, EditsReachTheFramesOfTheIncludingFileAndTheLastWins) {
  const TemporaryFolder folder;
  folder.write("edits.g", "Edit arm: { q: .5, limits: [-1 1] }");
  Config config;
  config.addFile(
      folder.write("scene.g",
                   "Edit (arm): { q: .1 }\n base: {}\n arm (base): { joint: hingeX, q: .2 }\n hand (arm): {}\n"
                   "Include: <edits.g>\n Edit arm: { q: .3 }\n Edit arm: { q: .4 }\n Edit (hand base): {}"));
  EXPECT_DOUBLE_EQ(config.getJointState()[0], .4);
  EXPECT_DOUBLE_EQ(config.getJointLimits()(1, 0), 1.);
  EXPECT_EQ(config.getFrame("hand").getParent()->getName(), "base");
}

TEST(Reader, ParentsMayBeWrittenWithoutTheirPrefix) {
  Config config = scene("Prefix: p_  x: {}  y (x): {}  z (p_y): { joint: hingeX }  w (y): { joint: hingeX, mimic: z }");
  EXPECT_EQ(config.getFrame("p_y").getParent()->getName(), "p_x");
  EXPECT_EQ(config.getJointDimension(), 1);
}

TEST(Reader, ScenesOfBefore2018AreUnderstood) {
  Config config = scene(R"g(
body world { }
body arm { X=<T t(1 0 0)> }
body hand { type=2 size=[0 0 .3 .05] }
shape plate (arm) { rel=<T t(0 0 .1)> type=0 size=[.1 .2 .3 0] }
shape (arm) { rel=<T d(90 1 0 0)> type=ST_sphere size=[0 0 0 .2] }
joint shoulder (world arm) { type=JT_hingeX A=<T t(0 0 1)> B=<T t(0 0 .5)> }
joint (arm hand) { type=3 from=<T t(0 1 0)> to=<T t(0 0 .2)> }
relative (-1) { Q:<t(0 0 1)> }
)g");
  EXPECT_EQ(config.getFrameNames(), (std::vector<std::string>{"world", "arm", "hand", "plate", "", "shoulder", "|hand",
                                                              "relative", "shoulder_origin", "|hand_origin"}));
  EXPECT_EQ(config.getFrame("plate").getSize(), (std::vector<double>{.1, .2, .3}));
  EXPECT_EQ(config.getFrame(4).getSize(), std::vector<double>{.2});
  EXPECT_EQ(config.getFrame("|hand").getJointType(), JointType::hingeZ);
  EXPECT_EQ(config.getFrame("relative").getParent()->getName(), "|hand");
  config.setJointState(Eigen::Vector2d(M_PI / 2, 0.));
  EXPECT_LT((config.getFrame("arm").getPose().p - Vector3d(0, -.5, 1)).norm(), 1e-12) << "the joint turns before B";
  EXPECT_LT((config.getFrame("hand").getPose().p - Vector3d(0, -.7, 2)).norm(), 1e-12);
}

TEST(Reader, TheFormsOf2018To2023AreUnderstood) {
  Config config = scene(R"g(
a { X:<t(0 0 .5) d(90 1 0 0)> shape:ST_box size:[1 1 1 0] contact }
b (a) { rel:<t(1 0 0)> shape:ST_cylinder size:[0 0 2 .1] }
c (a, b) { joint:JT_transX, pre:"t(0 1 0)", q:.5 }
marker { shape:marker size:[.3 0 0 0] }
)g");
  EXPECT_EQ(config.getFrame("a").data().shape->contact, 1);
  EXPECT_EQ(config.getFrame("b").getSize(), (std::vector<double>{2., .1}));
  EXPECT_EQ(config.getFrame("marker").getSize(), std::vector<double>{.3});
  EXPECT_EQ(config.getFrame("b").getParent()->getName(), "c");
  EXPECT_LT((config.getFrame("b").getRelativePose().p - Vector3d(1, 0, 0)).norm(), 1e-12)
      << "b keeps its relative pose";
  EXPECT_EQ(config.getFrame("c").getParent()->getName(), "c_origin");
}

TEST(Reader, IncludesThatFormALoopOrAreTooDeepAreErrors) {
  const TemporaryFolder folder;
  folder.write("a.g", "Include: <b.g>");
  const std::string loop = folder.write("b.g", "Include: <a.g>");
  EXPECT_THROW(Config().addFile(loop), ParseError);
  for (int i = 0; i < 60; ++i)
    folder.write("deep" + std::to_string(i) + ".g", "Include: <deep" + std::to_string(i + 1) + ".g>");
  EXPECT_THROW(Config().addFile(folder.write("deep.g", "Include: <deep0.g>")), ParseError);
  EXPECT_THROW(Config().addFile(loop + ".missing"), FileError);
}

TEST(Reader, IncludesOfSmallFilesCannotMakeHugeScenes) {
  const TemporaryFolder folder;
  std::string ten;
  for (int level = 0; level < 6; ++level) {
    folder.write("bomb" + std::to_string(level) + ".g", ten.empty() ? "a: {}" : ten);
    ten.clear();
    for (int i = 0; i < 10; ++i) ten += "Include: <bomb" + std::to_string(level) + ".g>\n";
  }
  try {
    Config().addFile(folder.write("scene.g", ten));
    FAIL();
  } catch (const ParseError& error) {
    EXPECT_NE(std::string(error.what()).find("the scene has grown beyond"), std::string::npos) << error.what();
  }
}

TEST(Reader, LoadingTheSameNamesTwiceIsWarnedOf) {
  const TemporaryFolder folder;
  const std::string path = folder.write("scene.g", "a: {}\n b: {}\n {x}");
  Config config;
  config.addFile(path);
  config.addFile(path, "other_");
  EXPECT_TRUE(config.takeWarnings().empty());
  config.addFile(path);
  const auto warnings = config.takeWarnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("duplicate frame names: 2 (a, b)"), std::string::npos) << warnings[0];
}

TEST(Reader, CheckReportsErrorsAndWarningsInOrder) {
  const TemporaryFolder folder;
  const SceneCheck check = checkSceneFile(folder.write("scene.g", "a: { colour: [1] }\nb(c): {}\nd: { shape: bax }"));
  ASSERT_EQ(check.messages.size(), 3u);
  EXPECT_EQ(check.errors, 2);
  EXPECT_EQ(check.warnings, 1);
  EXPECT_NE(check.messages[0].find("scene.g:2:1: error: parent of 'b'"), std::string::npos) << check.messages[0];
  EXPECT_NE(
      check.messages[1].find(
          "warning: frame 'a': unknown attribute 'colour'; did you mean 'color'?\n    a: { colour: [1] }\n         ^"),
      std::string::npos)
      << check.messages[1];
  EXPECT_EQ(checkSceneFile(KINEGRAPH_SOURCE_DIR "/models/panda/panda.g").messages, std::vector<std::string>());
}

TEST(Reader, AttributesOfOneFrameLeaveNothingBehindWhenTheyFail) {
  Config config;
  config.addFrame("base", "", "pose: [0 0 1]");
  for (const char* attributes : {"joint: hingeX, pre: [0 0 1], shape: bax", "joint: hingeX, post: [0 0 1], mass: heavy",
                                 "joint: {", "x: 1.2.3", "joint: hingeX, mimic: base"}) {
    EXPECT_THROW(config.addFrame("arm", "base", attributes), ParseError) << attributes;
    EXPECT_EQ(config.getFrameNames(), std::vector<std::string>{"base"}) << attributes;
    EXPECT_TRUE(config.getFrame("base").getChildren().empty()) << attributes;
  }
  config.addFrame("arm", "base", "{ joint: hingeX, pre: [0 0 1], post: [0 0 1], shape: sphere }");
  EXPECT_EQ(config.getFrameNames(), (std::vector<std::string>{"base", "arm", "|arm", "|arm_origin"}));
  EXPECT_DOUBLE_EQ(config.getFrame("arm").getPose().p.z(), 3.);
}

TEST(Reader, MeshesComeFromFiles) {
  const std::string folder = KINEGRAPH_SOURCE_DIR "/tests/data";
  Config config;
  config.addText(
      "m: { mesh: <tetrahedron.h5>, meshscale: [1 2 3] }\n p: { mesh_points: <tetrahedron.h5>, meshscale: .5 }\n"
      "c: { shape: ssCvx, size: [.1], core: <tetrahedron.h5> }\n r: { shape: lines, mesh_rope: [1 0 0 4] }",
      "s.g", folder);
  EXPECT_EQ(config.getFrame("m").data().shape->geometry->mesh->vertices[3], Vector3d(0, 0, 3));
  EXPECT_EQ(config.getFrame("p").getShapeType(), ShapeType::pointCloud);
  EXPECT_EQ(config.getFrame("p").data().shape->geometry->mesh->vertices[0], Vector3d(0, 0, .25));
  EXPECT_EQ(config.getFrame("c").data().shape->geometry->mesh->vertices.size(), 4u);
  EXPECT_EQ(config.getFrame("r").data().shape->geometry->mesh->vertices[2], Vector3d(.5, 0, 0));
}

TEST(Reader, EveryShapeTypeCanBeAskedForCollisionsEvenWithoutItsMesh) {
  for (const auto& [name, type] : shapeTypeNames()) {
    for (const char* size : {"[1]", "[1 1]", "[1 1 1]", "[1 1 1 .1]", "[1 1 1 .1 .1 .1 .1]", "[]"}) {
      Config config;
      try {
        config.addText("a: { shape: " + name + ", size: " + size +
                       ", contact: 1 }\n b(a): { joint: free, shape: sphere, size: [1], contact: 1 }");
      } catch (const ParseError&) {
        continue;
      }
      config.getCollisions(10.);
      EXPECT_EQ(config.getFrame("a").getShapeType(), type);
    }
  }
}

TEST(Reader, MutatedScenesLoadOrFailButNeverWorse) {
  const std::string samples[] = {
      kTutorialArm,
      "base: { X: \"t(0 0 .5)\", shape: ssBox, size: [1 1 1 .1], mass: 2, contact: -1 }\n"
      "arm (base): { joint: _xyc, pre: [0 0 1], post: \"d(90 1 0 0)\", q: [.1 .2 .3], limits: [-1 -1 -1 1 1 1] }\n"
      "hand (arm): { joint: hinge, axis: [0 1 1], mimic: arm2, joint_scale: 2 }\n Prefix: p_\n arm2 (base): { joint: "
      "hinge }\n"
      "Edit p_arm2 (arm): { Q: [0 0 1], color: [1 0 0] }\n Delete: hand\n q: [1 2 3 4]\n",
      "base:\n  shape: capsule\n  size: [1, .1]\narm(base):\n  origin: [0, 0, 1]\n  joint: quatBall\n  q: [1, 0, 0, "
      "0]\n"};
  const std::string alphabet = "{}[]()<>:=,;!~#'\"\\ \n\t.+-e09azT_\xff";
  Rng rng(12);
  int loaded = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = samples[i % 3];
    for (int k = int(rng.uniform(1, 5)); k > 0; --k) {
      const std::size_t at = std::size_t(rng.uniform(0, double(text.size())));
      const char c = alphabet[std::size_t(rng.uniform(0, double(alphabet.size())))];
      if (rng.uniform() < .6) {
        text[at] = c;
      } else {
        text.erase(at, 1 + std::size_t(rng.uniform(0, 6)));
      }
    }
    Config config;
    try {
      config.addText(text);
      config.getFrameState();
      ++loaded;
    } catch (const Error&) {
      EXPECT_EQ(config.getFrameDimension(), 0);
    }
  }
  EXPECT_GT(loaded, 100);
}
