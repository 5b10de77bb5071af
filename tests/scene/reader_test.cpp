#include "kinegraph/scene/reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "kinegraph/base/errors.h"
#include "kinegraph/scene/config.h"

using namespace kinegraph;

namespace {

Config scene(const char* text) {
  Config config;
  config.addText(text);
  return config;
}

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
  Config config = scene(R"g(b(a): { Q: [1 0 0] }  a: { X: <t(0 0 1)> }  c(a): { rel: "t(0 1 0)" }  d(a): { pose: [0 0 2] }
      e(a): { X: [0 0 5] })g");
  EXPECT_LT((config.getFrame("b").getPose().p - Vector3d(1, 0, 1)).norm(), 1e-15);
  EXPECT_LT((config.getFrame("c").getPose().p - Vector3d(0, 1, 1)).norm(), 1e-15);
  EXPECT_LT((config.getFrame("d").getPose().p - Vector3d(0, 0, 3)).norm(), 1e-15);
  EXPECT_LT((config.getFrame("e").getRelativePose().p - Vector3d(0, 0, 4)).norm(), 1e-15);
}

TEST(Reader, MimicJointsFollowWithAnyScale) {
  Config config = scene(R"g(a: {} j(a): { joint: transX, limits: [0 1] } k(a): { joint: transX, joint_scale: -2, mimic: (j) })g");
  ASSERT_EQ(config.getJointDimension(), 1);
  config.setJointState(VectorXd::Constant(1, .3));
  EXPECT_NEAR(config.getFrame("k").getPose().p.x(), -.6, 1e-15);
  EXPECT_EQ(config.getJointNames(), std::vector<std::string>{"j"});
}

TEST(Reader, IncludesEditsAndPrefixesAreCarriedOut) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "kinegraph_reader_test";
  std::filesystem::create_directories(folder / "sub");
  std::ofstream(folder / "sub" / "arm.g") << "base: {}\n link(base): { joint: hingeZ, q: .5 }\n tip(link): { mimic_shape: base }";
  std::ofstream(folder / "scene.g") << "Edit l_link: { joint: hingeX }\n Prefix: l_\n Include: <sub/arm.g>\n"
                                       "Prefix: r_\n Include <sub/arm.g>\n Delete: r_tip\n world: {}\n Edit r_base (world): {}";
  Config config;
  config.addFile((folder / "scene.g").string(), "x_");
  EXPECT_EQ(config.getFrameNames(),
            (std::vector<std::string>{"x_l_base", "x_l_link", "x_l_tip", "x_r_base", "x_r_link", "x_world"}));
  EXPECT_EQ(config.getFrame("x_l_link").getJointType(), JointType::hingeX);
  EXPECT_EQ(config.getFrame("x_r_base").getParent()->getName(), "x_world");
  EXPECT_EQ(config.getFrame("x_r_link").getParent()->getName(), "x_r_base");
  std::filesystem::remove_all(folder);
}

TEST(Reader, ErrorsNameThePlaceTheFrameAndTheNearestWord) {
  expectMessage("\n\na: { shape: bax, size: [1 1 1] }", "s.g:3:13: frame 'a', shape: unknown shape type 'bax'");
  expectMessage("a: { shape: bax, size: [1 1 1] }", "similar names: box");
  expectMessage("a: {} b(a): { joint: hingZ }", "similar names: hingeZ");
  expectMessage("table: {} b(tabel): {}", "similar names: table");
  expectMessage("a: { shape: box, size: [1 1] }", "size of a box has 3 numbers [x y z], not 2");
  expectMessage("a: { X: \"t(1 2)\" }", "'t' takes 3 numbers");
  expectMessage("a: { joint: hingeX }", "without a parent cannot have a joint");
  expectMessage("a: {} b(a): { joint: hingeX, limits: [1 -1] }", "a lower limit is above");
  expectMessage("a: {} b(a): { joint: hingeX, mimic: a }", "'a' has no joint");
  expectMessage("a(b): {} b(a): {}", "one of its descendants");
  expectMessage("a: { shape: box, size: [1 1 1] ", "no error");
  expectMessage("a: 3", "at the top of a scene stand frames");
  expectMessage("Include: <nope.g>", "scene file");
  expectMessage("a: { shape: box, color: red, size: [1 1 1] }", "expected numbers [..], got the text 'red'");
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
