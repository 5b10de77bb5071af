#include <gtest/gtest.h>

#include <random>

#include "kinegraph/common/errors.h"
#include "tests/perception/camera_above_table.h"

namespace kinegraph {
namespace {

const VectorXd kAngles = (VectorXd(3) << .3, -.5, .8).finished();

/// An arm of three links above a table with a box and a can, after frames of the scene's own.
Config sceneWithArm(const std::string& before = "", const VectorXd& q = kAngles) {
  Config C;
  C.addText(before + R"(
    table: { shape: ssBox, size: [.9, .7, .1, .005], pose: [0, .05, .6], contact: 1 }
    box: { shape: ssBox, size: [.06, .1, .08, .002], pose: [.15, -.1, .69], contact: 1 }
    can: { shape: cylinder, size: [.12, .03], pose: [-.2, -.1, .71], contact: 1 }
    base (table): { rel: [0, .25, .1] }
    first (base): { joint: hingeZ }
    upper (first): { shape: ssBox, size: [.06, .25, .08, .01], rel: [0, -.1, .05], contact: 1 }
    second (first): { joint: hingeX, pre: [0, -.22, .05] }
    lower (second): { shape: capsule, size: [.15, .03], rel: [0, 0, .1], contact: 1 }
    third (second): { joint: hingeX, pre: [0, 0, .2] }
    hand (third): { shape: ssBox, size: [.12, .05, .2, .005], rel: [0, 0, .1], contact: 1 }
    cam: { focalLength: 1., width: 640, height: 480 }
  )");
  aimCamera(C);
  C.setJointState(q);
  return C;
}

/// The image of a precise camera, with noise and holes.
DepthView noisyImageOf(const Config& C, unsigned seed) {
  DepthView view = imageOf(C);
  view.noise = .0006;
  view.bias = .0003;
  std::mt19937 engine(seed);
  std::normal_distribution<float> normal;
  for (float& d : view.depth) {
    d += .0006f * d * d * normal(engine);
    if (engine() % 20 == 0) d = 0.f;
  }
  return view;
}

RegisterOptions estimating(std::vector<Estimate> what) {
  return {.support = "table", .search_radius = .05, .prior = Prior::last, .estimate = std::move(what)};
}

double rotationBetween(const Pose& a, const Pose& b) { return a.q.angularDistance(b.q); }

TEST(EstimateSensors, JointOffsetsAreFoundWithinTheirCovariance) {
  const VectorXd offsets = (VectorXd(3) << .012, -.009, .015).finished();
  for (const unsigned seed : {0u, 1u, 2u}) {
    Config C = sceneWithArm(), truth = sceneWithArm();
    truth.setJointState(kAngles + offsets);
    const std::vector views{noisyImageOf(truth, seed)};
    C.getFrame("box").setPosition({.17, -.12, .69});
    const SeenScene seen = registerScene(C, views, {"box"}, estimating({Estimate::joints}));
    ASSERT_EQ(seen.joints, (std::vector<std::string>{"first", "second", "third"}));
    const VectorXd error = seen.joint_offsets - offsets;
    EXPECT_LT(error.cwiseAbs().maxCoeff(), .003) << seen.str();
    EXPECT_LT(error.dot(seen.joint_covariance.ldlt().solve(error)), 16.3) << seen.str();  // exceeded by 1 of 1000
    EXPECT_LT((C.getJointState() - kAngles - seen.joint_offsets).norm(), 1e-9);
    EXPECT_EQ(seen.frames.at("box").status, SeenStatus::seen);
    EXPECT_TRUE(seen.cameras.empty());
  }
}

TEST(EstimateSensors, JointsThatMimicOthersAreNoDofs) {
  const char* fingers = R"(
    rail: { pose: [5, 0, 0] }
    finger (rail): { joint: transX, shape: sphere, size: [.02] }
    follower (rail): { joint: transX, mimic: finger, shape: sphere, size: [.02] }
  )";
  const VectorXd q = (VectorXd(4) << .02, kAngles).finished(),
                 offsets = (VectorXd(4) << 0., .012, -.009, .015).finished();
  Config C = sceneWithArm(fingers, q), truth = sceneWithArm(fingers, q + offsets);
  const SeenScene seen = registerScene(C, std::vector{noisyImageOf(truth, 0)}, {"box"}, estimating({Estimate::joints}));
  ASSERT_EQ(seen.joints, (std::vector<std::string>{"finger", "first", "second", "third"}));
  EXPECT_LT((seen.joint_offsets - offsets).cwiseAbs().maxCoeff(), .003) << seen.str();
}

TEST(EstimateSensors, ACameraOffBySomeCentimetersReturnsToItsPose) {
  Config C = sceneWithArm();
  const Config truth = C;
  const std::vector views{noisyImageOf(truth, 3)};
  Frame camera = C.getFrame("cam");
  const Pose wrong(camera.getPosition() + Vector3d(.02, -.015, .01),
                   Quaterniond(Eigen::AngleAxisd(.025, Vector3d(1., 2., -1.).normalized())) * camera.getQuaternion());
  camera.setPose(wrong);
  C.getFrame("box").setPosition({.17, -.12, .69});
  const SeenScene seen = registerScene(C, views, {"box", "can"}, estimating({Estimate::camera}));
  const Pose is = truth.getFrame("cam").getPose();
  ASSERT_EQ(seen.cameras.size(), 1u);
  EXPECT_LT((seen.cameras[0].pose.p - is.p).norm(), .004) << seen.str();
  EXPECT_LT(rotationBetween(seen.cameras[0].pose, is), .004) << seen.str();
  EXPECT_LT((camera.getPosition() - seen.cameras[0].pose.p).norm(), 1e-9);
  const Vector3d error = seen.cameras[0].pose.p - is.p;
  EXPECT_LT(error.dot(seen.cameras[0].covariance.topLeftCorner<3, 3>().ldlt().solve(error)), 16.3);
  EXPECT_LT((C.getFrame("box").getPosition() - truth.getFrame("box").getPosition()).norm(), .003) << seen.str();
  EXPECT_EQ(C.getJointState(), kAngles);
}

TEST(EstimateSensors, ACameraGivenByAPoseIsEstimatedTogetherWithTheJoints) {
  Config C = sceneWithArm(), truth = sceneWithArm();
  const VectorXd offsets = (VectorXd(3) << -.008, .01, .0).finished();
  truth.setJointState(kAngles + offsets);
  DepthView view = noisyImageOf(truth, 4);
  const Pose is = truth.getFrame("cam").getPose();
  view.camera.clear();
  view.pose = Pose(is.p + Vector3d(-.01, .01, .01), is.q);
  const std::vector views{view};
  const SeenScene seen = registerScene(C, views, {"box"}, estimating({Estimate::camera, Estimate::joints}));
  EXPECT_LT((seen.cameras.at(0).pose.p - is.p).norm(), .006) << seen.str();
  EXPECT_LT((seen.joint_offsets - offsets).cwiseAbs().maxCoeff(), .006) << seen.str();
  EXPECT_LT((C.getFrame("box").getPosition() - truth.getFrame("box").getPosition()).norm(), .006) << seen.str();
}

TEST(EstimateSensors, WhatTheImagesDoNotShowStaysAndIsNamed) {
  Config C = sceneWithArm(), truth = sceneWithArm();
  truth.delFrame("hand");
  const std::vector views{noisyImageOf(truth, 5)};
  const SeenScene seen = registerScene(C, views, {"box"}, estimating({Estimate::joints}));
  ASSERT_EQ(seen.warnings.size(), 1u) << seen.str();
  EXPECT_NE(seen.warnings[0].find("'third'"), std::string::npos) << seen.str();
  EXPECT_LT(std::abs(seen.joint_offsets[2]), .003);
  EXPECT_GT(seen.joint_covariance(2, 2), .007 * .007);
  EXPECT_LT(seen.joint_covariance(0, 0), .003 * .003);
}

TEST(EstimateSensors, TheCovarianceOfAThingHasThatOfTheCamera) {
  Config C = sceneWithArm(), same = sceneWithArm();
  const std::vector views{noisyImageOf(C, 5)};
  const SeenScene exact = registerScene(same, views, {"box"}, estimating({})),
                  estimated = registerScene(C, views, {"box"}, estimating({Estimate::camera}));
  const MatrixXd& with = estimated.frames.at("box").covariance;
  EXPECT_GT(with.topLeftCorner(2, 2).trace(), exact.frames.at("box").covariance.topLeftCorner(2, 2).trace());
}

TEST(EstimateSensors, WithoutAJointOrWithAnotherNameIsAnError) {
  Config C;
  C.addText(R"(
    table: { shape: ssBox, size: [.9, .7, .1, .005], pose: [0, .05, .6], contact: 1 }
    cam: { focalLength: 1., width: 320, height: 240 }
  )");
  aimCamera(C);
  const std::vector views{imageOf(C)};
  EXPECT_THROW(registerScene(C, views, {}, estimating({Estimate::joints})), ValueError);
  EXPECT_THROW(estimateFromName("arm"), ValueError);
  Config moving = sceneWithArm();
  DepthView view = imageOf(moving);
  view.camera = "third";
  EXPECT_THROW(registerScene(moving, std::vector{view}, {"box"}, estimating({Estimate::camera})), ValueError);
  EXPECT_EQ(moving.getJointState(), kAngles);
}

}  // namespace
}  // namespace kinegraph
