#include <gtest/gtest.h>

#include "kinegraph/geometry/files/image_file.h"
#include "kinegraph/rendering/camera_renderer.h"
#include "kinegraph/scene/frame_setters.h"
#include "kinegraph/scene/loading/reader.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

/// A picture of 4 x 4 pixels whose quarters are red and green above, blue and yellow below.
Image fourColors() {
  Pixels pixels{4, 4, {}};
  for (int i = 0; i < 16; ++i) {
    const bool right = i % 4 >= 2, below = i / 4 >= 2;
    for (const bool on : {below ? right : !right, right, below && !right}) pixels.rgb.push_back(on ? 255 : 0);
  }
  return encodePng(pixels);
}

class Textures : public ::testing::Test {
 protected:
  /// Looks down from z = 2; x is to the right of the picture, and y up.
  static Camera fromAbove() {
    Camera camera;
    camera.pose = Pose({0., 0., 2.}, {0., 1., 0., 0.});
    camera.width = camera.height = 40;
    camera.focal_length = 2.;
    return camera;
  }

  /// Returns the colors a quarter of the picture away from its corners: above left and right, below left and right.
  std::string quarters(const Config& config, const Camera& camera = fromAbove()) {
    const CameraImage image = renderer_.render(config, camera);
    std::string names;
    for (const auto& [x, y] : {std::pair(10, 10), std::pair(29, 10), std::pair(10, 29), std::pair(29, 29)}) {
      const std::uint8_t* rgb = &image.rgb[3 * std::size_t(y * image.width + x)];
      const bool red = rgb[0] > 100, green = rgb[1] > 100, blue = rgb[2] > 100;
      names += red && green && blue ? 'w' : red && green ? 'y' : red ? 'r' : green ? 'g' : blue ? 'b' : '-';
    }
    return names;
  }

  TemporaryFolder folder_;
  std::string picture_ = folder_.write("four.png", fourColors().bytes);
  CameraRenderer renderer_;
};

}  // namespace

TEST_F(Textures, APictureOnAQuadIsUpright) {
  Config config;
  config.addText("q: { shape: quad, size: [1.8 1.8], texture: <four.png> }", "scene.g", folder_.path());
  EXPECT_EQ(quarters(config), "rgby");
}

TEST_F(Textures, EachSideOfABoxShowsAllOfIt) {
  Config config;
  config.addText("b: { shape: box, size: [1.8 1.8 .2], texture: <four.png> }", "scene.g", folder_.path());
  EXPECT_EQ(quarters(config), "rgby");
  Frame box = config.getFrame("b");
  box.setPose(parsePose("d(180 1 0 0)"));  // from below, y points up, too
  EXPECT_EQ(quarters(config), "ybgr");
  box.setShape(ShapeType::box, {1.8, .2, 1.8}).setPose(parsePose("d(-90 1 0 0)"));  // the side towards -y, with z up
  EXPECT_EQ(quarters(config), "rgby");
}

TEST_F(Textures, AMeshHasItsOwnTextureCoordinates) {
  folder_.write("quad.mtl", "newmtl m\nmap_Kd four.png\n");
  folder_.write(
      "quad.obj",
      "mtllib quad.mtl\nv -0.9 -0.9 0\nv 0.9 -0.9 0\nv 0.9 0.9 0\nv -0.9 0.9 0\nvt 1 1\nvt 0 1\nvt 0 0\nvt 1 0\n"
      "usemtl m\nf 1/1 2/2 3/3 4/4\n");
  Config config;
  config.addText("q: { mesh: <quad.obj> }", "scene.g", folder_.path());
  EXPECT_EQ(quarters(config), "ybgr");  // rotated by 180 degrees
}

TEST_F(Textures, TwoPicturesOnOneMeshStayApart) {
  Pixels white{1, 1, {255, 255, 255}};
  folder_.write("white.png", encodePng(white).bytes);
  folder_.write("quad.mtl", "newmtl a\nmap_Kd four.png\nnewmtl b\nmap_Kd white.png\nnewmtl c\nKd 0 0 1\n");
  folder_.write("quad.obj",
                "mtllib quad.mtl\nv -0.9 0 0\nv 0 0 0\nv 0 0.9 0\nv -0.9 0.9 0\nv 0.9 0 0\nv 0.9 0.9 0\nv -0.9 -0.9 "
                "0\nv 0 -0.9 0\n"
                "vt 0 0\nvt 0.4 0\nvt 0.4 0.4\nvt 0 0.4\n"
                "usemtl a\nf 1/1 2/2 3/3 4/4\nusemtl b\nf 2/1 5/2 6/3 3/4\nusemtl c\nf 7 8 2 1\n");
  Config config;
  config.addText("q: { mesh: <quad.obj> }", "scene.g", folder_.path());
  EXPECT_EQ(quarters(config).substr(0, 3), "bwb");
}

TEST_F(Textures, ARepeatedPictureBeginsAgain) {
  Config config;
  config.addText("q: { shape: quad, size: [3.6 3.6], texture: <four.png>, texture_repeat: [2 2] }", "scene.g",
                 folder_.path());
  EXPECT_EQ(quarters(config), "ybgr");  // the camera sees the middle, where four of them meet
}

TEST_F(Textures, OneThatChangesIsSeen) {
  Config config;
  config.addText("q: { shape: quad, size: [1.8 1.8], color: [0 0 1] }");
  EXPECT_EQ(quarters(config), "bbbb");
  Frame quad = config.getFrame("q");
  setTexture(quad, picture_);
  EXPECT_EQ(quarters(config), "rgby");
}

TEST_F(Textures, SegmentationIsNotDisturbed) {
  Config config;
  config.addText("a: { shape: quad, size: [1.8 1.8], texture: <four.png> }", "scene.g", folder_.path());
  const std::vector<std::int32_t> ids = renderer_.segment(config, fromAbove());
  EXPECT_EQ(ids[10 * 40 + 10], 0);
  EXPECT_EQ(ids[29 * 40 + 29], 0);
}

TEST_F(Textures, ADamagedPictureIsNamed) {
  const std::string broken = folder_.write("broken.png", fourColors().bytes.substr(0, 60));
  Config config;
  config.addText("q: { shape: quad, size: [1 1], texture: <broken.png> }", "scene.g", folder_.path());
  expectError<FileError>([&] { quarters(config); }, {"broken.png"});
}
