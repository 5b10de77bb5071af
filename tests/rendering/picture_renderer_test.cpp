#include "kinegraph/rendering/picture_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

constexpr int kPaper[] = {0xdf, 0xe3, 0xea};

/// Looks along the world's x axis from 1 m above the floor.
Camera pictureCamera() {
  Camera camera;
  camera.pose = lookAt({0., 0., 1.}, {1., 0., 1.});
  camera.width = 64;
  camera.height = 48;
  camera.focal_length = 1.;
  return camera;
}

int channel(const CameraImage& image, int row, int column, int k) {
  return image.rgb[std::size_t(3 * (row * image.width + column) + k)];
}

float depthAt(const CameraImage& image, int row, int column) {
  return image.depth[std::size_t(row * image.width + column)];
}

class Pictures : public ::testing::Test {
 protected:
  PictureRenderer renderer;
};

}  // namespace

TEST_F(Pictures, AWallTwoMetersAwayIsTwoMetersDeepEverywhere) {
  Config config;
  config.addText("wall: { X: [2.5 0 1], shape: box, size: [1 8 8], color: [1 0 0] }");
  const CameraImage image = renderer.render(config, pictureCamera());
  const auto [least, most] = std::minmax_element(image.depth.begin(), image.depth.end());
  EXPECT_NEAR(*least, 2., 1e-3);
  EXPECT_NEAR(*most, 2., 1e-3);
}

TEST_F(Pictures, TheFloorIsDeepAndTheSkyIsPaper) {
  const Config config;
  const CameraImage image = renderer.render(config, pictureCamera());
  for (int k = 0; k < 3; ++k) EXPECT_EQ(channel(image, 3, 20, k), kPaper[k]);
  EXPECT_EQ(depthAt(image, 3, 20), -1.f);
  // A depth is that of the lower right one of 2 x 2 samples: (row + .75 - 24) / 48 m below the axis at a depth of 1 m.
  const int row = 40;
  EXPECT_NEAR(depthAt(image, row, 30), 48. / (row + .75 - 24.), 2e-2);
}

TEST_F(Pictures, FlatColorsAreThoseOfTheShapes) {
  Config config;
  config.addText("wall: { X: [2.5 0 1], shape: box, size: [1 8 8], color: [.6 .4 .2] }");
  const CameraImage image = renderer.render(config, pictureCamera(), {.flat_colors = true});
  EXPECT_NEAR(channel(image, 24, 32, 0), 153, 1);
  EXPECT_NEAR(channel(image, 24, 32, 1), 102, 1);
  EXPECT_NEAR(channel(image, 24, 32, 2), 51, 1);
}

TEST_F(Pictures, GlassIsMixedWithWhatIsBehindItAndNotDeep) {
  Config config;
  config.addText(
      "glass: { X: [1 0 1], shape: box, size: [.01 .8 .8], color: [1 0 0 .5] }\n"
      "wall: { X: [2.5 0 1], shape: box, size: [1 8 8], color: [0 0 1] }");
  const CameraImage image = renderer.render(config, pictureCamera(), {.flat_colors = true});
  EXPECT_NEAR(channel(image, 24, 32, 0), 128, 2);
  EXPECT_NEAR(channel(image, 24, 32, 2), 128, 2);
  EXPECT_NEAR(depthAt(image, 24, 32), 2., 1e-3);
  const CameraImage without = renderer.render(config, pictureCamera(), {.flat_colors = true}, true);
  EXPECT_EQ(channel(without, 24, 32, 0), 0);
}

TEST_F(Pictures, LitSurfacesHaveNoSpeckles) {
  for (const double size : {.02, 1., 50.}) {
    Config config;
    Frame plate = config.addFrame("plate");
    plate.setShape(ShapeType::box, {4. * size, 4. * size, .1 * size}).setPosition({0., 0., size});
    Camera camera = pictureCamera();
    camera.pose = lookAt({.3 * size, -2.5 * size, 3.5 * size}, {.3 * size, 0., 1.05 * size});
    const CameraImage image = renderer.render(config, camera, {.distance = 3. * size});
    for (int row = 20; row < 28; ++row) {
      for (int column = 20; column < 44; ++column)
        EXPECT_NEAR(channel(image, row, column, 1), channel(image, row, column - 1, 1), 2) << size;
    }
  }
}

TEST_F(Pictures, AShadowFallsOnTheFloorAndOnShapes) {
  Config config;
  config.addText(
      "table: { X: [0 0 .5], shape: box, size: [2 2 .1], color: [.5 .5 .5] }\n"
      "roof: { X: [0 0 1.2], shape: box, size: [.5 .5 .05] }");
  Camera camera = pictureCamera();
  camera.pose = lookAt({.6, -2.5, 1.6}, {.35, -.3, .55});  // towards the shadow of the roof
  const auto middle = [&](bool shadows) {
    return channel(renderer.render(config, camera, {.shadows = shadows}), 24, 32, 1);
  };
  EXPECT_LT(middle(true), middle(false) - 20);
}

TEST_F(Pictures, AColoredFloorReachesTheHorizon) {
  const Config config;
  const CameraImage image =
      renderer.render(config, pictureCamera(), {.floor_color = Vector3d(.5, .1, .1), .distance = .05});
  for (int row = 25; row < 48; ++row)
    EXPECT_LT(channel(image, row, 20, 1), row < 30 ? kPaper[1] + 1 : kPaper[1] - 40) << row;
}

TEST_F(Pictures, ARepeatedPictureIsThatOfANewRendererAfterAnyMotion) {
  Config config;
  config.addText(
      "roof: { X: [2 0 1.2], shape: box, size: [.5 .5 .05] }\n"
      "ball: { X: [2 .2 .2], shape: sphere, size: [.15], color: [.2 .6 .3] }");
  Camera camera = pictureCamera();
  camera.pose = lookAt({0., 0., 1.5}, {2., 0., .2});
  for (const double y : {0., .3, .3, -.6}) {
    config.getFrame("roof").setPosition({2., y, 1.2});
    PictureRenderer other;
    EXPECT_EQ(renderer.render(config, camera).rgb, other.render(config, camera).rgb) << y;
  }
}

TEST_F(Pictures, AShadowLeavesNothingBehindWhenItsShapeGoes) {
  Config config;
  config.addText("roof: { X: [2 0 1], shape: box, size: [.5 .5 .05] }");
  Camera camera = pictureCamera();
  camera.pose = lookAt({0., 0., 1.5}, {2., 0., 0.});
  renderer.render(config, camera);
  config.delFrame("roof");
  EXPECT_EQ(renderer.render(config, camera).rgb, renderer.render(config, camera, {.shadows = false}).rgb);
}

TEST_F(Pictures, DepthsAreLeftOutOnRequest) {
  Config config;
  config.addText("wall: { X: [2.5 0 1], shape: box, size: [1 8 8] }");
  const CameraImage with = renderer.render(config, pictureCamera());
  const CameraImage without = renderer.render(config, pictureCamera(), {.has_depth = false});
  EXPECT_EQ(with.rgb, without.rgb);
  EXPECT_TRUE(without.depth.empty());
}

TEST_F(Pictures, EdgesAreMixedFromFourSamples) {
  Config config;
  config.addText("wall: { X: [2 0 1 .985 .174 0 0], shape: box, size: [.01 1 1], color: [0 0 0] }");
  const CameraImage image = renderer.render(
      config, pictureCamera(), {.has_floor = false, .background = Vector3d(1., 1., 1.), .flat_colors = true});
  std::set<int> seen;
  for (int i = 0; i < 64 * 48; ++i) seen.insert(image.rgb[std::size_t(3 * i)]);
  EXPECT_EQ(seen, (std::set<int>{0, 64, 128, 191, 255}));
}

TEST_F(Pictures, LinesOfTheFloorAreBeforeShapesBelowIt) {
  Config config;
  config.addText("pit: { X: [0 0 -.3], shape: box, size: [20 20 .2], color: [1 1 1] }");
  Camera camera = pictureCamera();
  camera.pose = lookAt({.5, .5, 3.}, {.5, .51, 0.});
  const auto darkest = [&](bool has_floor) {
    const CameraImage image = renderer.render(config, camera, {.has_floor = has_floor, .flat_colors = true});
    return *std::min_element(image.rgb.begin(), image.rgb.end());
  };
  EXPECT_EQ(darkest(false), 255);
  EXPECT_LT(darkest(true), 230);
}

TEST_F(Pictures, MoreLightsMakeAWallBrighter) {
  Config config;
  config.addText("wall: { X: [2.5 0 1], shape: box, size: [1 8 8], color: [.2 .2 .2] }");
  int last = 0;
  for (const std::size_t count : {1, 2, 3, 8}) {
    const PictureOptions options{.lights = std::vector<Vector3d>(count, Vector3d(-2., 0., 1.))};
    const int seen = channel(renderer.render(config, pictureCamera(), options), 24, 32, 1);
    EXPECT_GT(seen, last) << count;
    last = seen;
  }
}

TEST_F(Pictures, WrongOptionsAreRefused) {
  const Config config;
  expectError<ValueError>([&] { renderer.render(config, pictureCamera(), {.lights = std::vector<Vector3d>(9)}); },
                          {"9 lights"});
  expectError<ValueError>([&] { renderer.render(config, pictureCamera(), {.distance = 0.}); }, {"distance"});
}
