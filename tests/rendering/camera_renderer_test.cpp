#include "kinegraph/rendering/camera_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <thread>

#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

/// Looks along the world's x axis from the origin.
Camera forwardCamera() {
  Camera camera;
  camera.pose = lookAt({0., 0., 1.}, {1., 0., 1.});
  camera.width = 64;
  camera.height = 48;
  camera.focal_length = 1.;
  return camera;
}

constexpr const char* kWall = "wall: { X: [2.5 0 1], shape: box, size: [1 8 8], color: [1 0 0] }";

class Rendering : public ::testing::Test {
 protected:
  CameraRenderer renderer;
};

}  // namespace

TEST_F(Rendering, AWallTwoMetersAwayIsTwoMetersDeepEverywhere) {
  Config config;
  config.addText(kWall);
  const CameraImage image = renderer.render(config, forwardCamera());
  ASSERT_EQ(image.depth.size(), 64u * 48u);
  const auto [least, most] = std::minmax_element(image.depth.begin(), image.depth.end());
  EXPECT_NEAR(*least, 2., 1e-5);
  EXPECT_NEAR(*most, 2., 1e-5);
}

TEST_F(Rendering, AnotherThreadMayGoOn) {
  Config config;
  config.addText(kWall);
  CameraImage image;
  std::thread([&] { image = renderer.render(config, forwardCamera()); }).join();
  EXPECT_EQ(image.depth, renderer.render(config, forwardCamera()).depth);
}

TEST_F(Rendering, ImagesOfAnySizeFollowEachOther) {
  Config config;
  config.addText(kWall);
  for (const auto& [width, height] : {std::pair(31, 17), std::pair(700, 500), std::pair(1, 1), std::pair(302, 201)}) {
    Camera camera = forwardCamera();
    camera.width = width;
    camera.height = height;
    const CameraImage image = renderer.render(config, camera);
    EXPECT_EQ(image.rgb.size(), std::size_t(3 * width * height));
    EXPECT_NEAR(image.depth.front(), 2., 1e-5);
    EXPECT_NEAR(image.depth.back(), 2., 1e-5);
  }
}

TEST_F(Rendering, SmoothedEdgesDoNotMixFrames) {
  Config config;
  config.addText("near: { X: \"t(2 0 1) d(30 1 0 0)\", shape: box, size: [.1 .4 .4] }");
  for (int i = 1; i < 200; ++i) config.addFrame("nothing" + std::to_string(i));
  config.addText("behind: { X: [3 0 1], shape: box, size: [1 1 1] }");
  CameraRenderer smooth({.supersampling = 2});
  std::set<std::int32_t> seen;
  for (const std::int32_t id : smooth.segment(config, forwardCamera())) seen.insert(id);
  EXPECT_EQ(seen, (std::set<std::int32_t>{-1, 0, 200}));
}

TEST_F(Rendering, ShadowsDarkenUnlitSurfaces) {
  Config config;
  config.addText("plate: { X: [0 0 1], shape: box, size: [1 1 .05] }");
  Camera camera;
  camera.pose = lookAt({.7, -1.5, 2.5}, {.7, -.6, 0.});
  const auto mean = [&](bool shadows) {
    CameraRenderer shaded({.shadows = shadows});
    const CameraImage image = shaded.render(config, camera);
    double sum = 0.;
    for (const std::uint8_t value : image.rgb) sum += value;
    return sum / double(image.rgb.size());
  };
  EXPECT_LT(mean(true), mean(false) - 2.);
}

TEST_F(Rendering, AnImpossibleCameraIsRefused) {
  Camera camera = forwardCamera();
  camera.width = 0;
  expectError<ValueError>([&] { renderer.render(Config(), camera); }, {"0 x 48 pixels"});
}
