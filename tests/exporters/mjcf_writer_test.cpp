#include "kinegraph/exporters/writers.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "kinegraph/kinematics/kinematic_model.h"
#include "tests/exporters/mujoco_model.h"
#include "tests/exporters/random_scene.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

constexpr double kAgreement = 1e-9;

class WriteMjcf : public ::testing::Test {
 protected:
  static Config scene(const std::string& text) {
    Config config;
    config.addText(text);
    return config;
  }

  std::string save(const Config& config) {
    warnings_.clear();
    const std::string path = (folder_ / "m.xml").string();
    saveMjcf(config, path, &warnings_);
    return path;
  }

  Config again(const Config& config) {
    Config copy;
    copy.addFile(save(config));
    return copy;
  }

  TemporaryFolder folder_;
  std::vector<std::string> warnings_;
};

constexpr const char* kRobot = R"(
world: {}
floor (world): { shape: quad, size: [4 4], color: [.9 .9 .9] }
base (world): { pose: [0 0 .2], shape: cylinder, size: [.2 .1], contact: 1 }
shoulder (base): { joint: hinge, axis: [1 2 3], limits: [-1 2], pre: [.1 .2 .3], q: .3 }
upper (shoulder): { pose: [0 .1 .4 1 .2 .3 .1], mass: 2, inertia: [.1 .2 .15], shape: capsule, size: [.3 .05], contact: -1 }
rail (upper): { joint: transY, joint_scale: -1, limits: [-.1 .4], q: .1 }
cart (rail): { pose: [.1 0 0 1 1 0 0], shape: ssBox, size: [.1 .1 .1 .01], contact: -2 }
follow (upper): { joint: hingeX, mimic: shoulder, joint_scale: .5, shape: sphere, size: [.1] }
tool (cart): { joint: quatBall, q: [1 .2 .3 .4], shape: marker }
tcp (cart): { pose: [0 0 .2] }
eye (cart): { pose: [0 .1 0], shape: camera, heightAngle: 40 }
cube (world): { joint: free, q: [1 2 3 1 0 1 0], shape: box, size: [.1 .2 .3], contact: 1 }
)";

}  // namespace

TEST_F(WriteMjcf, MujocoFindsTheSamePosesByTheNamesOfTheJoints) {
  Config config = scene(kRobot);
  MujocoModel model(save(config));
  EXPECT_TRUE(warnings_.empty()) << warnings_[0];
  model.useKeyframe();
  EXPECT_LT(model.largestDifference(config), kAgreement);
  Rng rng(1);
  for (int sample = 0; sample < 20; ++sample) {
    const double a = rng.uniform(-1., 2.), b = rng.uniform(-.1, .4);
    config.setJointState(Eigen::Vector2d(a, b), {"shoulder", "rail"});
    model.setJoint("shoulder", a);
    model.setJoint("rail", b);
    model.setJoint("follow", .5 * a);
    model.update();
    EXPECT_LT(model.largestDifference(config), kAgreement);
  }
}

TEST_F(WriteMjcf, MujocoFindsTheSamePosesInRandomScenes) {
  for (int seed = 0; seed < 60; ++seed) {
    Rng rng(seed);
    const Config config = randomScene(rng, true);
    const std::string path = save(config);
    MujocoModel model(path);
    model.useKeyframe();
    EXPECT_LT(model.largestDifference(config, 0), kAgreement) << "seed " << seed;
  }
}

TEST_F(WriteMjcf, NamesPosesAndContactsComeBack) {
  const Config config = scene(kRobot);
  Config copy = again(config);
  EXPECT_EQ(copy.getJointNames(), config.getJointNames());
  EXPECT_TRUE(copy.getJointLimits().cwiseMin(1e9).cwiseMax(-1e9).isApprox(
      config.getJointLimits().cwiseMin(1e9).cwiseMax(-1e9), 1e-15));
  const std::vector<std::string> joints = {"shoulder", "rail", "tool"};
  copy.setJointState(config.getJointState(joints), joints);
  for (const char* name : {"base", "upper", "cart", "follow", "tool", "tcp", "eye", "cube", "floor"}) {
    EXPECT_TRUE((copy.getFrame(name).getPose().inverse() * config.getFrame(name).getPose()).isIdentity(1e-12)) << name;
  }
  const auto pairs = [](const Config& c) {
    std::set<std::string> names;
    for (const auto& [a, b] : c.getCollidablePairs()) {
      const auto [first, second] = std::minmax(c.getFrame(a).data().name, c.getFrame(b).data().name);
      names.insert(first + "-" + second);
    }
    return names;
  };
  const std::set<std::string> before = pairs(config), after = pairs(copy);
  EXPECT_FALSE(before.empty());
  EXPECT_FALSE(after.empty());
  EXPECT_EQ(after.count("base-cart"), before.count("base-cart"));
}

TEST_F(WriteMjcf, ARobotReadFromMjcfComesBackWithTheSameFrames) {
  const std::string text = R"(<mujoco><compiler angle="radian"/><worldbody>
    <body name="a" pos="0 0 1" quat="1 .2 .3 0"><joint name="j" axis="1 2 0" pos=".1 .2 .3" range="-1 1"/>
      <joint name="k" type="slide" axis="1 1 0"/><geom name="ga" size=".1"/><site name="s" pos="1 0 0"/>
      <body name="b" pos="1 0 0"><joint name="l" axis="0 0 -1"/><geom name="gb" type="box" size=".1 .2 .3"/></body></body>
    <body name="c"><joint name="m" axis="0 1 0"/><geom name="gc" size=".1"/></body>
    </worldbody><equality><joint joint1="m" joint2="l" polycoef="0 2"/></equality>
    <contact><exclude body1="a" body2="c"/></contact></mujoco>)";
  std::ofstream(folder_ / "r.xml") << text;
  Config config;
  config.addFile((folder_ / "r.xml").string());
  Config copy = again(config);
  EXPECT_EQ(copy.getFrameNames(), config.getFrameNames());
  EXPECT_EQ(copy.getCollidablePairs(), config.getCollidablePairs());
  Rng rng(2);
  for (int sample = 0; sample < 5; ++sample) {
    const VectorXd q = Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal());
    config.setJointState(q);
    copy.setJointState(q);
    EXPECT_LT((copy.getFrameState() - config.getFrameState()).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST_F(WriteMjcf, MeshesStandInTheTextOrInFilesBesideIt) {
  const Config config = scene(
      "hull: { shape: ssCvx, core: [0 0 0 1 0 0 0 1 0 0 0 1], size: [.01] }\n"
      "tri: { shape: mesh, vertices: [0 0 0 1 0 0 0 1 0 0 0 1], triangles: [0 2 1 0 1 3 0 3 2 1 2 3] }");
  EXPECT_NE(writeMjcf(config).find("vertex=\"0 0 0 1 0 0"), std::string::npos);
  const std::string path = save(config);
  EXPECT_EQ(MujocoModel(path).model().nmesh, 2);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "m_meshes"), {}), 2);
  Config copy;
  copy.addFile(path);
  EXPECT_EQ(copy.getFrame("tri").getShapeType(), ShapeType::mesh);
}

TEST_F(WriteMjcf, AJointOutsideOfQIsFixedWithAWarning) {
  const Config config = scene(
      "a: {} j (a): { joint: hingeX, q: .3 } f_origin (j): { pose: [0 0 1] } f (f_origin): { joint: transY, q: .04, "
      "joint_active: False } tip (f): { pose: [0 0 0 1 1 0 0] } g (j): { joint: transY, mimic: f, joint_scale: -1 }");
  MujocoModel model(save(config));
  model.useKeyframe();
  EXPECT_LT(model.largestDifference(config, 0), kAgreement);
  EXPECT_EQ(again(config).getJointNames(), std::vector<std::string>{"j"});
  ASSERT_EQ(warnings_.size(), 2u);
  std::sort(warnings_.begin(), warnings_.end());
  EXPECT_NE(warnings_[0].find("joint 'f' is not in q"), std::string::npos);
  EXPECT_NE(warnings_[1].find("joint 'g' is fixed because the joint 'f' it mimics is fixed"), std::string::npos);
}

TEST_F(WriteMjcf, PairsThatMujocoCannotTestOrDistinguishAreListed) {
  save(
      scene("world: {} base (world): { joint: rigid, shape: sphere, size: [.1], contact: 1 } j (base): { joint: "
            "hingeX, shape: sphere, size: "
            "[.1], contact: 1 } k (j): { joint: hingeX, shape: sphere, size: [.1], contact: 1 }"));
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("lost pairs: j - k"), std::string::npos) << warnings_[0];
}
