#include "kinegraph/rendering/camera_renderer.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"
#include "tests/support/near.h"

using namespace kinegraph;

namespace {

Camera smallCamera() {
  Camera camera;
  camera.width = 80;
  camera.height = 60;
  camera.focal_length = 1.;
  return camera;
}

std::vector<float> flat(const Camera& camera, float depth) {
  return std::vector<float>(std::size_t(camera.width) * std::size_t(camera.height), depth);
}

}  // namespace

TEST(DepthImage, PixelCentersBecomePointsOnTheirRays) {
  const std::vector<float> depth = {2.f, -1.f, 4.f, 1.f, 3.f, 2.f};
  const std::vector<double> points = depthToPoints(depth.data(), 2, 3, {10., 20., 1., 1.});
  ASSERT_EQ(points.size(), 18u);
  const auto at = [&](int i) { return Vector3d(Eigen::Map<const Vector3d>(points.data() + 3 * i)); };
  EXPECT_TRUE(near(at(0), Vector3d(-.1, -.05, 2.), 1e-12));
  EXPECT_TRUE(near(at(1), Vector3d::Zero(), 0.));
  EXPECT_TRUE(near(at(2), Vector3d(.6, -.1, 4.), 1e-12));
  EXPECT_TRUE(near(at(4), Vector3d(.15, .075, 3.), 1e-12));
}

TEST(DepthNoise, WithoutAmplitudeOnlyPointsOfOneEyeAreLost) {
  const Camera camera = smallCamera();
  std::vector<float> depth = flat(camera, 1.f);
  DepthNoise noise;
  noise.overall = 0.;
  noise.baseline = .05;  // 3 pixels at 1 m
  Rng rng(0);
  addDepthNoise(depth, flat(camera, 1.f), camera, noise, rng);
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      EXPECT_EQ(depth[std::size_t(row * camera.width + column)], column < 3 ? -1.f : 1.f) << row << " " << column;
    }
  }
}

TEST(DepthNoise, PointsAtAnotherDepthInTheOtherEyeAreLost) {
  const Camera camera = smallCamera();
  std::vector<float> depth = flat(camera, 1.f);
  Rng rng(0);
  addDepthNoise(depth, flat(camera, 2.f), camera, {}, rng);
  EXPECT_EQ(depth, flat(camera, -1.f));
}

TEST(DepthNoise, GrowsWithTheSquareOfDepth) {
  const Camera camera = smallCamera();
  const auto spread = [&](float d) {
    std::vector<float> depth = flat(camera, d);
    DepthNoise noise;
    noise.baseline = 0.;
    Rng rng(1);
    addDepthNoise(depth, flat(camera, d), camera, noise, rng);
    double sum = 0.;
    for (const float x : depth) sum += double(x - d) * double(x - d);
    return std::sqrt(sum / double(depth.size()));
  };
  EXPECT_GT(spread(1.f), 1e-3);
  EXPECT_NEAR(spread(2.f) / spread(1.f), 4., 1e-3);
}

TEST(DepthNoise, TheBackgroundHasTheDefaultDepth) {
  const Camera camera = smallCamera();
  std::vector<float> depth = flat(camera, -1.f);
  DepthNoise noise;
  noise.overall = noise.baseline = 0.;
  Rng rng(0);
  addDepthNoise(depth, flat(camera, -1.f), camera, noise, rng);
  EXPECT_EQ(depth, flat(camera, 3.f));
}

TEST(DepthNoise, NegativeSizesAreRefused) {
  DepthNoise noise;
  noise.wide = -1.;
  expectError<ValueError>([&] { noise.validate(); }, {"-1"});
}

TEST(DepthNoise, TheOtherEyeIsToTheRight) {
  Camera camera = smallCamera();
  camera.pose.q = Quaterniond(axisRotation(2, std::acos(0.)));  // its x axis is the world's y axis
  DepthNoise noise;
  noise.baseline = .1;
  EXPECT_TRUE(near(otherEye(camera, noise).pose.p, Vector3d(0., .1, 0.), 1e-12));
}
