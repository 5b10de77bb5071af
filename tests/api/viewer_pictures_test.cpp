#include "kinegraph/api/viewer_pictures.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;

class ViewerPicturesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    setenv("KINEGRAPH_HEADLESS", "1", 1);
    config.addText("table: { X: [0 0 .5], shape: box, size: [1 1 .1], color: [.8 .8 .8] }\n shelf: { X: [0 0 1] }");
    viewer.setWindow("", 160, 120);
    viewer.setCamera({3., 0., 1.}, {0., 0., 1.});  // the point (0, 0, 1) is in the middle; y is to the right
  }
  /// Returns the color of the pixel where the camera sees a point of the plane x = 0.
  Vector3d colorAt(double y, double z) {
    const CameraImage image = viewer.getRgb();
    const double pixels = viewer.camera().focal_length * image.height / 3.;  // per m
    const int row = int(image.height / 2. - (z - 1.) * pixels), column = int(image.width / 2. + y * pixels);
    const std::uint8_t* rgb = &image.rgb[std::size_t(3 * (row * image.width + column))];
    return {double(rgb[0]), double(rgb[1]), double(rgb[2])};
  }
  bool isRed(double y, double z) {
    const Vector3d color = colorAt(y, z);
    return color[0] > color[1] + 60. && color[0] > color[2] + 60.;
  }

  Config config;
  ConfigViewer& viewer = config.viewer();
};

TEST_F(ViewerPicturesTest, LinesHaveTheirWidthAndRoundEnds) {
  viewer.line("path", {{0., -.5, 1.2}, {0., .5, 1.2}}, {.color = {1., 0., 0., 1.}, .width = 10.});
  const double pixel = 3. / (viewer.camera().focal_length * 120.);
  EXPECT_TRUE(isRed(0., 1.2));
  EXPECT_TRUE(isRed(0., 1.2 + 4. * pixel));
  EXPECT_FALSE(isRed(0., 1.2 + 6.5 * pixel));
  EXPECT_TRUE(isRed(.5 + 3. * pixel, 1.2));
  EXPECT_FALSE(isRed(.5 + 4.5 * pixel, 1.2 + 4.5 * pixel));
  viewer.remove("path");
  EXPECT_FALSE(isRed(0., 1.2));
}

TEST_F(ViewerPicturesTest, PointsHaveTheirSizeInMeters) {
  viewer.points("cloud", {{0., 0., 1.2}}, {.color = {1., 0., 0., 1.}, .size = .2});
  EXPECT_TRUE(isRed(.08, 1.28));
  EXPECT_FALSE(isRed(.13, 1.2));
}

TEST_F(ViewerPicturesTest, DrawingsFollowTheirFrames) {
  viewer.arrow("up", {0., .2, 0.}, {0., 0., .3}, {.frame = "shelf", .color = {1., 0., 0., 1.}, .size = .06});
  viewer.arrow("of nothing", {0., -.5, 0.}, {0., 0., .3}, {.frame = "none", .color = {1., 0., 0., 1.}, .size = .06});
  EXPECT_TRUE(isRed(.2, 1.1));
  EXPECT_FALSE(isRed(-.5, .1));
  config.getFrame("shelf").setPosition({0., -.4, 1.});
  EXPECT_FALSE(isRed(.2, 1.1));
  EXPECT_TRUE(isRed(-.2, 1.1));
}

TEST_F(ViewerPicturesTest, ImagesShowTheirFirstRowOnTheSideOfNegativeY) {
  Pose upright = lookAt({3., 0., 1.}, {0., 0., 1.});  // its y axis points down
  upright.p = {0., 0., 1.};
  viewer.image("picture", {1, 2, {255, 0, 0, 0, 0, 255}}, upright, {.size = .4});  // .8 m high
  EXPECT_TRUE(isRed(0., 1.3));
  EXPECT_GT(colorAt(0., .7)[2], 200.);
}

TEST_F(ViewerPicturesTest, LabelsAreWrittenAboveEverything) {
  const Vector3d before = colorAt(0., 1.);
  viewer.label("note", {-1., 0., 1.}, "WWWWW");
  const CameraImage image = viewer.getRgb();
  int dark = 0;
  for (int row = 50; row < 70; ++row) {
    for (int column = 50; column < 110; ++column) dark += image.rgb[std::size_t(3 * (row * 160 + column))] < 90;
  }
  EXPECT_GT(dark, 40);
  EXPECT_GT(before.minCoeff(), 90.);
}

TEST_F(ViewerPicturesTest, DepthsAreThoseOfTheScene) {
  const CameraImage before = viewer.getDepth();
  viewer.line("path", {{1., -.5, 1.}, {1., .5, 1.}}, {.width = 30.});
  EXPECT_EQ(viewer.getDepth().depth, before.depth);
}

TEST_F(ViewerPicturesTest, FilesAreCountedUnlessTheyAreNamed) {
  const fs::path folder = fs::temp_directory_path() / ("viewer_pictures_" + std::to_string(getpid()));
  const std::string prefix = (folder / "a" / "p").string();
  EXPECT_EQ(viewer.savePng(prefix), prefix + "000000.png");
  EXPECT_EQ(viewer.savePng(prefix), prefix + "000001.png");
  EXPECT_EQ(viewer.savePng(prefix, 7), prefix + "000007.png");
  EXPECT_EQ(viewer.savePng(prefix + ".png"), prefix + ".png");
  std::ifstream file(prefix + ".png", std::ios::binary);
  const Pixels read = decodeImage({std::string(std::istreambuf_iterator<char>(file), {})});
  EXPECT_EQ(read.rgb, viewer.getRgb().rgb);
  fs::remove_all(folder);
  expectError<ValueError>([&] { viewer.savePng("a.jpg"); }, {"a.jpg", "PNG"});
  expectError<FileError>([&] { viewer.savePng("/proc/a.png"); }, {"/proc/a.png"});
}

TEST_F(ViewerPicturesTest, FitBringsTheWholeSceneIntoThePicture) {
  config.addText("far: { X: [0 9 .5], shape: sphere, size: [.5], color: [1 0 0] }");
  const Vector3d center = viewer.fit();
  EXPECT_NEAR(center.y(), .5 * (9.5 - .5), 1e-2);
  const CameraImage image = viewer.getRgb();
  bool is_seen = false;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) is_seen |= image.rgb[i] > image.rgb[i + 1] + 60;
  EXPECT_TRUE(is_seen);
}

TEST_F(ViewerPicturesTest, CameraAndImagesAreThoseOfLaterPages) {
  viewer.setQuad(-1, {1, 1, {255, 0, 0}}, .1, .1, .2);
  EXPECT_TRUE(isRed(-.8, 1.5));
  EXPECT_FALSE(viewer.isOpen());
  config.view();
  EXPECT_EQ(viewer.quads().size(), 1u);
  EXPECT_NEAR(viewer.camera().pose.p.x(), 3., 1e-12);
  viewer.close();
  EXPECT_TRUE(viewer.quads().empty());
  EXPECT_NEAR(viewer.camera().pose.p.y(), 5., 1e-12);  // the initial one
  expectError<ValueError>([&] { viewer.setQuad(-1, {2, 1, {255, 0, 0}}, .1, .1, .2); }, {"3 bytes", "1 x 2"});
}

TEST_F(ViewerPicturesTest, PicturesAreOfTheAssignedScene) {
  Config other;
  other.addText("ball: { X: [0 0 1], shape: sphere, size: [.3], color: [1 0 0] }");
  EXPECT_FALSE(isRed(0., 1.));
  config = other;
  EXPECT_EQ(&config.viewer(), &viewer);
  EXPECT_TRUE(isRed(0., 1.));
}

TEST_F(ViewerPicturesTest, PicturesAreOfTheSceneAgainAfterAnotherOneWasShown) {
  Config other;
  other.addText("ball: { X: [0 0 1], shape: sphere, size: [.3], color: [1 0 0] }");
  viewer.update(other);
  EXPECT_TRUE(isRed(0., 1.));
  EXPECT_EQ(&config.viewer(), &viewer);
  EXPECT_FALSE(isRed(0., 1.));
}

TEST_F(ViewerPicturesTest, TextsAreBrokenAnewInPicturesOfAnotherSize) {
  const auto sized = [](ConfigViewer& shown, int width) {
    shown.setWindow("", width, 120);
    return shown.getRgb().rgb;
  };
  Config same = config;
  const Camera camera = viewer.camera();
  for (ConfigViewer* shown : {&viewer, &same.viewer()}) {
    shown->setCamera(camera);
    shown->label("note", {0., 0., 1.}, "some words that need several lines in narrow pictures");
  }
  sized(viewer, 400);
  EXPECT_EQ(sized(viewer, 120), sized(same.viewer(), 120));
}

TEST_F(ViewerPicturesTest, AFailedPictureIsNotCounted) {
  const std::string prefix = (fs::temp_directory_path() / ("not_counted_" + std::to_string(getpid()))).string();
  ConfigViewer other;
  expectError<ValueError>([&] { other.savePng(prefix); }, {"no scene yet"});
  other.update(config);
  EXPECT_EQ(other.savePng(prefix), prefix + "000000.png");
  fs::remove(prefix + "000000.png");
}

TEST(ViewerPictures, ACameraThatFollowsAFrameKeepsNoScene) {
  setenv("KINEGRAPH_HEADLESS", "1", 1);
  std::weak_ptr<SceneTree> scene;
  {
    Config config;
    config.addText("eye: { X: [0 0 1] }\n camera_track: { X: [0 0 2] }");
    scene = config.scene();
    config.viewer().setCamera(config.getFrame("eye"));
    config.getFrame("camera_track").setPosition({0., 0., 3.});
    EXPECT_NEAR(config.viewer().camera().pose.p.z(), 3., 1e-12);
  }
  EXPECT_TRUE(scene.expired());
}

TEST(ViewerPictures, ACameraStaysWhereItsFrameWasLast) {
  Config config;
  config.addText("eye: { X: [0 0 1] }");
  ConfigViewer& viewer = config.viewer();
  viewer.setCamera(config.getFrame("eye"));
  config.getFrame("eye").setPosition({0., 0., 2.});
  EXPECT_NEAR(viewer.camera().pose.p.z(), 2., 1e-12);
  config.delFrame("eye");
  EXPECT_NEAR(viewer.camera().pose.p.z(), 2., 1e-12);
}

TEST(ViewerPictures, PagesHaveTheCameraOfTheScene) {
  setenv("KINEGRAPH_HEADLESS", "1", 1);
  const auto isAimed = [](const std::string& scene) {
    Config config;
    config.addText(scene);
    ConfigViewer plain;
    plain.update(config);
    config.view();
    return config.viewer().recording() != plain.recording();
  };
  EXPECT_FALSE(isAimed("eye: { X: [0 0 1] }"));
  EXPECT_TRUE(isAimed("camera_init: { X: [0 0 1] }"));
}

TEST(ViewerPictures, AViewerWithoutASceneSaysSo) {
  ConfigViewer viewer;
  expectError<ValueError>([&] { viewer.getRgb(); }, {"no scene yet"});
}

}  // namespace
}  // namespace kinegraph
