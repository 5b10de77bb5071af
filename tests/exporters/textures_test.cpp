#include <gtest/gtest.h>

#include <algorithm>

#include "kinegraph/common/text.h"
#include "kinegraph/exporters/writers.h"
#include "kinegraph/geometry/files/image_file.h"
#include "kinegraph/geometry/files/mesh_file.h"
#include "kinegraph/scene/frame_setters.h"
#include "kinegraph/scene/tree/scene_bytes.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

const std::string kPicture = encodePng({2, 1, {255, 0, 0, 0, 255, 0}}).bytes;

class TextureFormats : public ::testing::Test {
 protected:
  Config load(const std::string& text, const std::string& name) {
    Config config;
    config.addText(text, name, folder_.path());
    return config;
  }
  static std::string pictureOf(const Config& config, const std::string& frame) {
    const auto& shape = config.getFrame(frame).data().shape;
    return shape && shape->texture ? shape->texture->bytes : "";
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.write("picture.png", kPicture);
};

}  // namespace

TEST_F(TextureFormats, AWrittenSceneKeepsItsPictures) {
  Config config = load(
      "a: { shape: box, size: [1 1 1], texture: <picture.png>, texture_repeat: [2 3] } b: { shape: quad, size: [1 1] }",
      "a.g");
  Mesh mesh{{{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}}, {{0, 1, 2}}, {}};
  Frame c = config.addFrame("c").setMesh(mesh);
  setTexture(c, path_, {0., 0., 1., 0., .5, 1.});
  const std::string text = writeScene(config);
  Config again;
  again.addText(text, "b.g", "/");
  EXPECT_EQ(pictureOf(again, "a"), kPicture);
  EXPECT_EQ(pictureOf(again, "b"), "");
  EXPECT_EQ(pictureOf(again, "c"), kPicture);
  EXPECT_EQ(again.getFrame("c").data().shape->geometry->mesh->texcoords[2], (std::array{.5f, 1.f}));
  EXPECT_EQ(again.getFrame("a").data().shape->texture_repeat, (std::array{2., 3.}));
  EXPECT_EQ(writeScene(again), text);
}

TEST_F(TextureFormats, TheBytesOfASceneHoldThem) {
  Config config = load(
      "a: { shape: box, size: [1 1 1], texture: <picture.png> } b: { shape: quad, size: [1 1], texture: <picture.png> "
      "}",
      "a.g");
  const auto scene = sceneFromBytes(sceneToBytes(*config.scene()));
  EXPECT_EQ(scene->frames()[0]->shape->texture->bytes, kPicture);
}

TEST_F(TextureFormats, GltfHoldsThem) {
  Config config =
      load("a: { shape: quad, size: [2 2], texture: <picture.png> } b: { shape: box, size: [1 1 1], color: [0 0 1] }",
           "a.g");
  const std::string path = (folder_ / "scene.glb").string();
  writeGltf(config, path);
  std::filesystem::remove(path_);
  const Mesh mesh = readMeshFile(path);
  ASSERT_EQ(mesh.textures.size(), 1u);
  EXPECT_EQ(mesh.textures[0].image->bytes, kPicture);
  EXPECT_EQ(mesh.textures[0].count, 2u);
  for (std::uint32_t t = mesh.textures[0].first; t < mesh.textures[0].first + 2; ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {  // glTF has y up: -z is our y
      EXPECT_NEAR(mesh.texcoords[v][0], mesh.vertices[v].x() > 0. ? 1. : 0., 1e-6);
      EXPECT_NEAR(mesh.texcoords[v][1], mesh.vertices[v].z() < 0. ? 1. : 0., 1e-6);
    }
  }
}

TEST_F(TextureFormats, UrdfMaterialsHaveThem) {
  Config config = load(
      "<robot name=\"r\"><material name=\"m\"><texture filename=\"picture.png\"/></material><link name=\"l\"><visual>"
      "<geometry><box size=\"1 1 1\"/></geometry><material name=\"m\"/></visual></link></robot>",
      "a.urdf");
  const auto& frames = config.scene()->frames();
  const auto shown =
      std::find_if(frames.begin(), frames.end(), [](const auto& f) { return f->shape && f->shape->texture; });
  ASSERT_NE(shown, frames.end());
  EXPECT_EQ((*shown)->shape->texture->bytes, kPicture);
  EXPECT_NE(writeUrdf(config).find(cat("<texture filename=\"", path_, "\"/>")), std::string::npos);
}

TEST_F(TextureFormats, MjcfMaterialsHaveThem) {
  Config config = load(R"(<mujoco><compiler texturedir="."/><asset>
      <texture name="t" type="2d" file="picture.png"/><texture name="c" type="2d" builtin="checker" rgb1="0 0 0" rgb2="1 0 0" width="8" height="8"/>
      <material name="m" texture="t" texrepeat="2 3"/><material name="u" texture="t" texrepeat="2 3" texuniform="true"/>
      <material name="l"><layer role="rgb" texture="t"/></material><material name="k" texture="c"/></asset>
      <worldbody><body name="b"><geom name="g" type="box" size="1 2 3" material="m"/><geom name="h" type="box" size="1 2 3" material="u"/>
      <geom name="i" type="box" size="1 2 3" material="l"/><geom name="j" type="box" size="1 2 3" material="k"/></body></worldbody></mujoco>)",
                       "a.xml");
  for (const char* name : {"g", "h", "i"}) EXPECT_EQ(pictureOf(config, name), kPicture) << name;
  EXPECT_EQ(config.getFrame("g").data().shape->texture_repeat, (std::array{2., 3.}));
  EXPECT_EQ(config.getFrame("h").data().shape->texture_repeat, (std::array{4., 12.}));
  EXPECT_TRUE(config.getFrame("j").data().shape->color->isApprox(Vector4d(.5, 0., 0., 1.)));
}

TEST_F(TextureFormats, H5FilesNameThem) {
  std::filesystem::copy(cat(KINEGRAPH_SOURCE_DIR, "/tests/data/textured.h5"), folder_ / "textured.h5");
  Config config = load("a: { mesh: <textured.h5> }", "a.g");
  const Mesh& mesh = *config.getFrame("a").data().shape->geometry->mesh;
  ASSERT_EQ(mesh.textures.size(), 1u);
  EXPECT_EQ(mesh.textures[0].image->bytes, kPicture);
  EXPECT_EQ(mesh.texcoords[2], (std::array{0.f, .75f}));  // these files count from above
}

TEST_F(TextureFormats, AMissingPictureIsAWarningThatHelps) {
  Config config = load("a: { shape: box, size: [1 1 1], texture: <pictre.png> }", "a.g");
  const std::vector<std::string> warnings = config.takeWarnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("pictre.png' does not exist; similar names: picture.png"), std::string::npos)
      << warnings[0];
}

TEST_F(TextureFormats, CoordinatesThatDoNotFitAreErrors) {
  expectError<ParseError>(
      [&] {
        load("a: { shape: mesh, vertices: [0 0 0 1 0 0 0 1 0], triangles: [0 1 2], texcoords: [0 0 1 0] }", "a.g");
      },
      {"a.g:1:", "texcoords", "expected 2 numbers for each of 3 vertices, got 4"});
  Config config = load("q: { shape: quad, size: [1 1] }", "a.g");
  Frame quad = config.getFrame("q");
  expectError<ValueError>([&] { setTexture(quad, path_, {0., 0.}); }, {"frame 'q' has no mesh", "2 per vertex"});
  Frame bare = config.addFrame("bare");
  expectError<ValueError>([&] { setTexture(bare, path_); }, {"frame 'bare' has no shape"});
}
