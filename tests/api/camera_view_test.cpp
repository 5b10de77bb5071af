#include "kinegraph/api/camera_view.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

Config wallAndCamera() {
  Config config;
  config.addText(R"(
    wall: { X: [2.5 0 1], shape: box, size: [1 8 8], color: [1 0 0] }
    eye: { X: [0 0 1 .5 .5 .5 .5], shape: camera, width: 64, height: 48, focalLength: 1 }
  )");
  return config;
}

float nearestDepth(CameraView& view) {
  const std::vector<float> depth = view.computeImageAndDepth().depth;
  return *std::ranges::min_element(depth);
}

TEST(CameraView, SeesTheSceneFromAFrameAndFollowsIt) {
  Config config = wallAndCamera();
  CameraView view(config);
  view.setCamera("eye");
  EXPECT_EQ(view.camera().width, 64);
  EXPECT_EQ(view.getFxycxy(), Vector4d(48., 48., 32., 24.));
  const CameraImage near = view.computeImageAndDepth();
  ASSERT_EQ(near.depth.size(), 64u * 48u);
  EXPECT_NEAR(*std::ranges::min_element(near.depth), 2., 1e-5);

  config.getFrame("eye").setPosition({.5, 0., 1.});
  EXPECT_NEAR(nearestDepth(view), 1.5, 1e-5);
  const std::vector<std::int32_t> ids = view.computeSegmentationID();
  EXPECT_EQ(ids[24 * 64 + 32], config.getFrame("wall").id());
}

TEST(CameraView, StaysAtAFixedCamera) {
  Config config = wallAndCamera();
  CameraView view(config);
  Camera camera = view.setCamera("eye").camera();
  camera.pose.p.x() = .7;
  view.setCamera(camera);
  config.getFrame("eye").setPosition({-1., 0., 1.});
  EXPECT_NEAR(nearestDepth(view), 1.3, 1e-5);
}

TEST(CameraView, ErrorsAreReported) {
  CameraView view(wallAndCamera());
  Camera flat;
  flat.width = 0;
  expectError<FrameNotFound>([&] { view.setCamera("eyes"); }, {"eyes", "eye"});
  expectError<ValueError>([&] { view.setCamera(flat); }, {"0 x 480 pixels"});
}

}  // namespace
}  // namespace kinegraph
