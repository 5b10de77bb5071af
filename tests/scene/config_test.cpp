#include "kinegraph/scene/config.h"

#include <gtest/gtest.h>

#include <limits>

#include <functional>

#include "kinegraph/common/errors.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "tests/support/crowd.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;
using namespace kinegraph::testing;

namespace {

constexpr const char* kArm = R"(
base: { shape: ssBox, size: [.4 .4 .1 .01], contact: 1 }
j1(base): { pre: [0 0 .1], joint: hingeZ, limits: [-2 2] }
link1(j1): { Q: [.2 0 .1], shape: capsule, size: [.3 .05], contact: 1 }
j2(link1): { pre: [.2 0 0], joint: hingeY, limits: [-2 2], q: .3 }
link2(j2): { Q: [.2 0 .05], shape: ssBox, size: [.3 .08 .06 .01], contact: 1, mass: .5 }
ball(link2): { joint: quatBall, shape: sphere, size: [.05] }
free(base): { joint: free }
)";

Config arm() {
  Config config;
  config.addText(kArm);
  return config;
}

Config chain(int contact) {
  Config config;
  config.addText("base: { shape: sphere, size: [.1], contact: 1 }");
  std::string parent = "base";
  for (const char* name : {"l1", "l2", "l3", "l4"}) {
    config.addFrame(name, parent, "joint: hingeX, shape: sphere, size: [.1], contact: " + std::to_string(contact));
    parent = name;
  }
  return config;
}

std::vector<std::string> pairs(const Config& config) {
  std::vector<std::string> names;
  for (auto [a, b] : config.getCollidablePairs())
    names.push_back(config.getFrame(a).getName() + "-" + config.getFrame(b).getName());
  return names;
}

}  // namespace

TEST(Config, WorldPosesOfStateAndOfTheTreeAgree) {
  Config config = arm();
  Rng rng(1);
  for (int sample = 0; sample < 10; ++sample) {
    VectorXd q = config.getJointState();
    for (double& x : q) x += .3 * rng.normal();
    config.setJointState(q);
    const State& state = config.state();
    for (const auto& frame : config.scene()->frames()) {
      EXPECT_LT((frame->worldPose().transform().R - state.pose(frame->id).R).norm(), 1e-13) << frame->name;
      EXPECT_LT((frame->worldPose().p - state.pose(frame->id).p).norm(), 1e-13) << frame->name;
    }
  }
}

TEST(Config, SettingAWorldPoseOfAFreeJointReachesIt) {
  Config config = arm();
  const Pose target = Pose::fromNumbers((VectorXd(7) << 1, 2, 3, .5, .5, -.5, .5).finished());
  config.getFrame("free").setPose(target);
  EXPECT_TRUE((config.getFrame("free").getPose().inverse() * target).isIdentity(1e-14));
}

TEST(Config, JointNamesMatchQOneToOne) {
  EXPECT_EQ(arm().getJointNames(),
            (std::vector<std::string>{"j1", "j2", "ball:0", "ball:1", "ball:2", "ball:3", "free:0", "free:1", "free:2",
                                      "free:3", "free:4", "free:5", "free:6"}));
  EXPECT_EQ(arm().getJointLimits().col(0), Eigen::Vector2d(-2, 2));
  EXPECT_EQ(arm().getJointLimits().col(5),
            Eigen::Vector2d(-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()));
}

TEST(Config, SelectJointsChangesQAndKeepsTheOthersWhereTheyAre) {
  Config config = arm();
  config.setJointState(config.getJointState() + VectorXd::Constant(13, .1));
  const Vector3d before = config.getFrame("link2").getPose().p;
  config.selectJoints({"link1"});
  EXPECT_EQ(config.getJointNames(), std::vector<std::string>{"j1"});
  EXPECT_LT((config.getFrame("link2").getPose().p - before).norm(), 1e-14);
  config.selectJoints({}, true);
  EXPECT_EQ(config.getJointDimension(), 13);
}

TEST(Config, CollidablePairsFollowTheContactFlags) {
  EXPECT_EQ(pairs(chain(1)).size(), 10u);
  EXPECT_EQ(pairs(chain(-1)), (std::vector<std::string>{"base-l2", "base-l3", "base-l4", "l1-l3", "l1-l4", "l2-l4"}));
  EXPECT_EQ(pairs(chain(-2)), (std::vector<std::string>{"base-l3", "base-l4", "l1-l4"}));
  EXPECT_EQ(pairs(chain(-3)), std::vector<std::string>{"base-l4"});
  EXPECT_TRUE(pairs(chain(-4)).empty());
}

TEST(Config, CollisionsAreNeverStale) {
  Config config;
  config.addText(
      "a: { shape: sphere, size: [.1], contact: 1 }  b: { X: [.15 0 0], shape: sphere, size: [.1], contact: 1 }");
  config.addText("c: { X: [1 0 0], shape: marker, size: [.1] }");
  ASSERT_EQ(config.getCollisions().size(), 1u);
  EXPECT_NEAR(config.getCollisions()[0].distance, -.05, 1e-14);
  config.getFrame("b").setPosition({.5, 0, 0});
  EXPECT_TRUE(config.getCollisions().empty());
  EXPECT_NEAR(config.getCollisions(1.).at(0).distance, .3, 1e-14);
  config.getFrame("b").setContact(0);
  EXPECT_TRUE(config.getCollisions(1.).empty());
  config.getFrame("c").setShape(ShapeType::sphere, {.5}).setContact(1);
  EXPECT_TRUE(config.getCollisions().empty());
  config.delFrame("b");
  EXPECT_NEAR(config.getCollisions(1.).at(0).distance, .4, 1e-14);
}

TEST(Config, CollisionsAreThoseOfAFreshCopyAfterEveryKindOfEdit) {
  for (const int others : {6, 100}) {  // few and many bodies are searched in different ways
    Config config = crowd(others, .6, 8);
    Rng rng(9);
    const std::vector<std::pair<std::string, std::function<void()>>> edits = {
        {"nothing", [] {}},
        {"setJointState",
         [&] { config.setJointState(config.getJointState() + .1 * VectorXd::Ones(config.getJointDimension())); }},
        {"setJointState of one", [&] { config.setJointState(VectorXd::Constant(1, .7), {"link1"}); }},
        {"setPosition",
         [&] {
           config.getFrame("body1").setPosition({.1, .1, .1});
         }},
        {"setPose of a moving frame",
         [&] {
           config.getFrame("body0").setPosition({.2, 0, 0});
         }},
        {"setFrameState",
         [&] { config.setFrameState(config.getFrame("body1").getPose().numbers().transpose(), {"body2"}); }},
        {"setShape",
         [&] {
           config.getFrame("body1").setShape(ShapeType::ssBox, {.6, .6, .6, .1});
         }},
        {"setMesh",
         [&] {
           Mesh mesh;
           mesh.vertices = {{0, 0, 0}, {.5, 0, 0}, {0, .5, 0}, {0, 0, .5}};
           mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
           config.getFrame("body3").setMesh(mesh);
         }},
        {"setContact 0", [&] { config.getFrame("body1").setContact(0); }},
        {"setContact 1", [&] { config.getFrame("body1").setContact(1); }},
        {"addFrame", [&] { config.addFrame("new", "link1", "shape: sphere, size: [.3], contact: 1"); }},
        {"setRelativePosition",
         [&] {
           config.getFrame("new").setRelativePosition({.1, .2, .3});
         }},
        {"setJoint", [&] { config.getFrame("new").setJoint(JointType::hingeZ); }},
        {"attach", [&] { config.attach("link0", "body2"); }},
        {"setParent", [&] { config.getFrame("body3").setParent(config.getFrame("link2"), false); }},
        {"unLink", [&] { config.getFrame("body3").unLink(); }},
        {"selectJoints",
         [&] {
           config.selectJoints({"link0", "link1"});
         }},
        {"delFrame", [&] { config.delFrame("body1"); }},
        {"setRandom", [&] { config.setRandom(rng); }},
        {"addConfigurationCopy", [&] { config.addConfigurationCopy(Config(config), "copy_"); }},
        {"clear", [&] { config.clear(); }},
    };
    std::size_t seen = 0;
    for (const auto& [name, edit] : edits) {
      edit();
      const auto near = config.getCollisions(.1), expected = measuredCollisions(config, .1);
      ASSERT_EQ(near.size(), expected.size()) << name << ", " << others;
      double sum = 0.;
      for (std::size_t i = 0; i < near.size(); ++i) {
        EXPECT_EQ(near[i].a, expected[i].a) << name;
        EXPECT_EQ(near[i].b, expected[i].b) << name;
        EXPECT_EQ(near[i].distance, expected[i].distance) << name;
        sum += std::max(-near[i].distance, 0.);
      }
      EXPECT_NEAR(config.getTotalPenetration(), sum, 1e-12) << name;
      EXPECT_EQ(Config(config).getCollisions(.1).size(), near.size()) << name;
      seen += near.size();
    }
    EXPECT_GT(seen, 50u);
  }
}

TEST(Config, CopiesAreDeep) {
  Config original = arm();
  Config copy = original;
  copy.getFrame("base").setPosition({5, 0, 0});
  copy.setJointState(copy.getJointState() + VectorXd::Ones(13));
  EXPECT_EQ(original.getFrame("base").getPose().p.x(), 0.);
  EXPECT_EQ(original.getJointState()[0], 0.);
  EXPECT_EQ(copy.getFrame("link1").getPose().p.x() > 4., true);
}

TEST(Config, CopiesOfACompiledSceneCompileOnlyWhenTheyAreEdited) {
  Config original = arm();
  const auto model = original.model();
  Config copy = original;
  EXPECT_EQ(copy.model(), model);
  EXPECT_EQ(copy.getJointState(), original.getJointState());
  copy.addFrame("more", "base");
  EXPECT_NE(copy.model(), model);
  EXPECT_EQ(copy.model()->frame_name.back(), "more");
  EXPECT_EQ(original.model(), model);
  original.setJointState(original.getJointState() + VectorXd::Ones(13));
  EXPECT_NEAR((copy.getJointState() - original.getJointState()).norm(), std::sqrt(13.), 1e-12);
}

TEST(Config, SnapshotsKeepWhatTheSceneWasAndAreUsedAgain) {
  Config config = arm();
  const auto first = config.scene()->snapshot();
  const VectorXd q = config.getJointState();
  config.setJointState(q + VectorXd::Ones(13));
  config.getFrame("base").setPosition({5, 0, 0});
  auto second = config.scene()->snapshot();
  EXPECT_NE(first, second);
  EXPECT_EQ(Config(*first).getJointState(), q);
  EXPECT_EQ(Config(*first).getFrame("base").getPose().p.x(), 0.);
  EXPECT_EQ(Config(*second).getJointState(), q + VectorXd::Ones(13));
  const SceneTree* address = second.get();
  second.reset();
  config.getFrame("base").setPosition({6, 0, 0});
  second = config.scene()->snapshot();
  EXPECT_EQ(second.get(), address);
  EXPECT_EQ(Config(*second).getFrame("base").getPose().p.x(), 6.);
  config.addFrame("new");
  EXPECT_EQ(Config(*config.scene()->snapshot()).getFrameDimension(), config.getFrameDimension());
}

TEST(Config, AttachKeepsTheFrameWhereItIs) {
  Config config = arm();
  const Vector3d before = config.getFrame("free").getPose().p;
  config.attach("link2", "free");
  EXPECT_EQ(config.getFrame("free").getParent()->getName(), "link2");
  EXPECT_EQ(config.getJointDimension(), 6);
  EXPECT_LT((config.getFrame("free").getPose().p - before).norm(), 1e-14);
  EXPECT_THROW(config.attach("link2", "base"), ValueError);
  EXPECT_EQ(config.getFrame("base").getParent(), std::nullopt);
}

TEST(Config, AttachOfAFrameWithoutJointSaysWhatToDoAndThatWorks) {
  Config config;
  config.addText(
      "table {}\n"
      "arm (table) { joint: hingeZ }\n"
      "hand (arm) { pose: [1 0 0] }\n"
      "box (table) { pose: [1 .2 0], shape: box, size: [.1 .1 .1] }\n");
  expectError<ValueError>([&] { config.attach("hand", "box"); },
                          {"'box' has no joint and is fixed to 'table'", "also carries 'hand'", "setJoint"});
  config.getFrame("box").setJoint(JointType::rigid);
  config.attach("hand", "box");
  EXPECT_EQ(config.getFrame("box").getParent()->getName(), "hand");
  EXPECT_TRUE(config.getFrame("box").getPosition().isApprox(Vector3d(1., .2, 0.), 1e-12));
}

TEST(Config, MistakesAreExplained) {
  Config config = arm();
  expectError([&] { config.getFrame("lnik2"); }, {"similar names: link2"});
  expectError([&] { config.addFrame("x", "bsae"); }, {"similar names: base"});
  expectError([&] { config.setJointState(VectorXd::Zero(3)); }, {"got 3 numbers; the configuration has 13"});
  expectError([&] { config.addFrame("y", "base", "shape: bax"); }, {"similar names: box"});
  EXPECT_FALSE(config.findFrame("y")) << "a frame whose attributes are wrong is not added";
}

TEST(Config, AFrameMayBeAskedForTwiceButNotAsAnotherOne) {
  Config config = arm();
  const Frame base = config.getFrame("base");
  const Frame tool = config.addFrame("tool", "base", "joint: hingeX, pre: [0 0 1], note: x");
  EXPECT_EQ(config.addFrame("tool"), tool);
  EXPECT_EQ(config.addFrame("tool", base), tool);
  EXPECT_EQ(config.addFrame("tool", "base", "joint: hingeX, pre: [0 0 1], note: x"), tool);
  ASSERT_EQ(config.takeWarnings().size(), 3u);
  const int count = config.getFrameDimension();
  expectError<ValueError>([&] { config.addFrame("tool", "link2"); },
                          {"'tool' already exists, below 'base', not below 'link2'", "'tool_2'"});
  expectError<ValueError>([&] { config.addFrame("base", "link2"); }, {"without a parent, not below 'link2'"});
  expectError<ValueError>([&] { config.addFrame("tool", "base", "joint: hingeY"); },
                          {"with other attributes", "delFrame('tool')"});
  EXPECT_EQ(config.getFrameDimension(), count);
  EXPECT_EQ(config.getFrame("tool").getJointType(), JointType::hingeX);
}

TEST(Config, FramesOfOneNameAreDistinguishedByTheirHandles) {
  Config config;
  config.addText("a: { X: [1 0 0] }  a: { X: [2 0 0] }");
  EXPECT_EQ(config.addFrame("b", config.getFrame(1)).getPose().p.x(), 2.);
  config.delFrame(config.getFrame(1));
  EXPECT_EQ(config.getFrame("a").getPose().p.x(), 1.);
  EXPECT_EQ(config.getFrameNames(), (std::vector<std::string>{"a", "b"}));
  Config other = config;
  expectError<ValueError>([&] { other.delFrame(config.getFrame("a")); }, {"'a' belongs to another configuration"});
}
