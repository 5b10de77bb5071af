#include "kinegraph/scene/loading/robot_semantics.h"

#include <gtest/gtest.h>

#include "kinegraph/scene/config.h"
#include "kinegraph/scene/tree/named_states.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

using Kind = RobotSemantics::Member::Kind;
using Groups = std::vector<std::pair<std::string, std::vector<std::string>>>;

constexpr const char* kRobot =
    "base: { shape: sphere, size: [.1] } j1 (base): { joint: hingeX } l1 (j1): { shape: sphere, size: [.1], contact: 1 "
    "} "
    "j2 (l1): { joint: hingeY } l2 (j2): { shape: sphere, size: [.1], contact: 1 } j3 (l2): { joint: hingeY, mimic: j2 "
    "} "
    "f (base): { joint: free } l3 (f): { shape: sphere, size: [.1], contact: 1 }";

struct RobotSemanticsTest : ::testing::Test {
  RobotSemanticsTest() {
    config.addText(kRobot);
    semantics.file = "robot.srdf";
  }
  SceneTree& tree() { return *config.scene(); }
  void apply() { applySemantics(semantics, tree(), diagnostics); }

  Config config;
  RobotSemantics semantics;
  SceneDiagnostics diagnostics;
};

}  // namespace

TEST_F(RobotSemanticsTest, PairsNeverCollideOnceTheyAreNamed) {
  EXPECT_EQ(config.getCollidablePairs().size(), 3u);
  semantics.no_contact = {{"l1", "l2", {}}, {"l2", "l1", {}}};
  apply();
  EXPECT_EQ(config.getCollidablePairs().size(), 2u);
  EXPECT_EQ(config.getFrame("l1").data().no_contact.size() + config.getFrame("l2").data().no_contact.size(), 1u);
  EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST_F(RobotSemanticsTest, AllPairsOfALinkButThoseTakenOut) {
  config.clear();
  config.addText(
      "base: {} l1 (base): { joint: hingeX } s1 (l1): { shape: sphere, size: [.1], contact: 1 } l2 (l1): { joint: "
      "hingeX } "
      "s2 (l2): { shape: sphere, size: [.1], contact: 1 } l3 (base): { joint: hingeX } s3 (l3): { shape: sphere, size: "
      "[.1], contact: 1 }");
  EXPECT_EQ(config.getCollidablePairs().size(), 3u);
  semantics.no_contact = {{"l3", "", {}}};
  semantics.contact = {{"l3", "l2", {}}};
  apply();
  EXPECT_EQ(config.getCollidablePairs().size(), 2u);  // s1 s2, s2 s3
}

TEST_F(RobotSemanticsTest, NoFlagLeavesOutAPairThatIsNotNamed) {
  const char* arm =
      "world: {} base (world): { shape: sphere, size: [.1], contact: -2 } l1 (base): { joint: hingeX, shape: sphere, "
      "size: "
      "[.1], contact: -2 } l2 (l1): { joint: hingeX, shape: sphere, size: [.1], contact: -2 } l3 (l2): { joint: "
      "hingeX, "
      "shape: sphere, size: [.1], contact: -2 } ";
  const char* other =
      "a (world): { joint: hingeX, shape: sphere, size: [.1], contact: -2 } b (a): { joint: hingeX, shape: sphere, "
      "size: "
      "[.1], contact: -2 }";
  config.clear();
  config.addText(arm);
  EXPECT_EQ(config.getCollidablePairs().size(), 1u) << "the flags leave out links up to two joints above";
  semantics.no_contact = {{"l1", "l2", {}}};
  apply();
  EXPECT_EQ(config.getCollidablePairs().size(), 5u);  // all 6 but one
  Config two;
  two.addText(std::string(arm) + other);
  const std::size_t before = two.getCollidablePairs().size();
  applySemantics(semantics, *two.scene(), diagnostics);
  EXPECT_EQ(two.getCollidablePairs().size(), before + 4);
  EXPECT_EQ(two.getFrame("b").data().shape->contact, -2) << "another robot keeps its own rule";
}

TEST_F(RobotSemanticsTest, FlagsStayWhereAFileSaysNothingOfPairs) {
  config.clear();
  config.addText(
      "a: { shape: sphere, size: [.1], contact: -2 } b (a): { joint: hingeX, shape: sphere, size: [.1], contact: -2 }");
  semantics.groups = {{"arm", {{Kind::joint, "b", "", {}}}}};
  apply();
  EXPECT_TRUE(config.getCollidablePairs().empty());
}

TEST_F(RobotSemanticsTest, GroupsHoldTheMovingJointsOfChainsLinksAndOtherGroups) {
  semantics.groups = {
      {"arm", {{Kind::chain, "base", "l2", {}}}},
      {"last", {{Kind::link, "l2", "", {}}, {Kind::joint, "j3", "", {}}}},
      {"all", {{Kind::group, "arm", "", {}}, {Kind::group, "all", "", {}}, {Kind::joint, "f", "", {}}}}};
  apply();
  EXPECT_EQ(jointGroups(tree()), (Groups{{"arm", {"j1", "j2"}}, {"all", {"j1", "j2", "f"}}, {"last", {"j2"}}}));
}

TEST_F(RobotSemanticsTest, AChainThatDoesNotExistIsAWarning) {
  semantics.groups = {{"arm", {{Kind::chain, "l2", "base", {"robot.srdf", 3, 5}}}}};
  apply();
  ASSERT_EQ(diagnostics.warnings().size(), 1u);
  EXPECT_EQ(diagnostics.warnings()[0],
            "robot.srdf:3:5: the chain from 'l2' to 'base' does not exist: 'l2' is not above 'base'");
}

TEST_F(RobotSemanticsTest, StatesReorderTheQuaternionsOfFreeJoints) {
  semantics.states = {{"away", "", {{"f", {1., 2., 3., 0., 0., .6, .8}, {}}, {"j1", {.3}, {}}, {"j3", {9.}, {}}}}};
  apply();
  VectorXd expected(9);
  expected << .3, 0., 1., 2., 3., .8, 0., 0., .6;
  EXPECT_EQ(namedState(tree(), "away"), expected);
}

TEST_F(RobotSemanticsTest, MisspeltNamesAreWarningsWithTheNearestOnes) {
  semantics.no_contact = {{"l1", "l9", {"robot.srdf", 7, 1}}};
  semantics.states = {{"home", "", {{"j1", {1., 2.}, {"robot.srdf", 8, 1}}, {"world", {0.}, {}}}}};
  semantics.outside = {"world"};
  apply();
  ASSERT_EQ(diagnostics.warnings().size(), 2u);
  EXPECT_NE(diagnostics.warnings()[0].find("robot.srdf:7:1: the scene has no link 'l9'; similar names: l1"),
            std::string::npos);
  EXPECT_NE(diagnostics.warnings()[1].find("state 'home': joint 'j1' has 1 dof, not 2"), std::string::npos);
}

TEST_F(RobotSemanticsTest, ThoseOfAnotherRobotAreAnErrorOnlyIfAskedFor) {
  semantics.no_contact = {{"left", "right", {}}};
  semantics.requested = false;
  apply();
  EXPECT_FALSE(diagnostics.failed());
  semantics.requested = true;
  apply();
  EXPECT_TRUE(diagnostics.failed());
}

TEST_F(RobotSemanticsTest, APrefixIsPutBeforeNames) {
  Config two;
  two.addText("Prefix: r_ " + std::string(kRobot));
  semantics.prefix = "r_";
  semantics.states = {{"home", "", {{"j1", {.5}, {}}}}};
  applySemantics(semantics, *two.scene(), diagnostics);
  EXPECT_EQ(stateNames(*two.scene()), std::vector<std::string>{"home"});
  EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(RobotSemanticsFile, IsTheOneBesideTheRobotOrInTheFolderSrdf) {
  TemporaryFolder folder;
  std::filesystem::create_directories(folder / "urdf");
  std::filesystem::create_directories(folder / "srdf");
  const std::string robot = folder.write("urdf/arm.urdf", "");
  EXPECT_EQ(semanticsBeside(robot), "");
  const std::string far = folder.write("srdf/arm.srdf", "");
  EXPECT_EQ(semanticsBeside(robot), far);
  const std::string near = folder.write("urdf/arm.srdf", "");
  EXPECT_EQ(semanticsBeside(robot), near);
  EXPECT_EQ(semanticsBeside((folder / "urdf/arm.xml").string()), "");
  EXPECT_TRUE(isSemanticsFile("a/B.SRDF"));
  EXPECT_FALSE(isSemanticsFile("a/srdf"));
}
