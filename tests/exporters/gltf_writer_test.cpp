#include "kinegraph/exporters/writers.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "kinegraph/geometry/files/mesh_file.h"
#include "tests/support/near.h"
#include "tests/support/scene.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

/// Reads the written scene with the mesh reader, z up again.
Mesh readAgain(const Config& config) {
  const TemporaryFolder folder;
  const std::string path = (folder / "scene.glb").string();
  writeGltf(config, path);
  Mesh mesh = readMeshFile(path);
  const Matrix3d up = axisRotation(0, M_PI / 2);
  for (Vector3d& p : mesh.vertices) p = up * p;
  return mesh;
}

constexpr double kFloatPrecision = 1e-6;

}  // namespace

TEST(WriteGltf, VerticesStandWhereTheFramesAre) {
  Config config = scene(
      "base: { pose: [1 2 3] }\n"
      "arm (base): { joint: hingeX, q: .5 }\n"
      "plate (arm): { pose: [0 0 1 1 1 0 0], shape: mesh, vertices: [0 0 0 1 0 0 0 1 0 0 0 1], triangles: [0 2 1 0 1 "
      "3] }");
  const Mesh mesh = readAgain(config);
  const Frame plate = config.getFrame("plate");
  const Mesh& own = *plate.data().shape->geometry->mesh;
  EXPECT_EQ(mesh.vertices.size(), own.vertices.size());
  ASSERT_EQ(mesh.triangles.size(), own.triangles.size());
  for (std::size_t i = 0; i < own.triangles.size(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {  // the reader counts vertices in the order of the triangles
      const Vector3d expected = plate.getPose().transform() * own.vertices[own.triangles[i][corner]];
      EXPECT_TRUE(near(mesh.vertices[mesh.triangles[i][corner]], expected, kFloatPrecision)) << i << ", " << corner;
    }
  }
}

TEST(WriteGltf, ColorsAreThoseOfShapesAndVertices) {
  const Mesh red = readAgain(scene("a: { shape: box, size: [1 1 1], color: [1 0 0 .4] }"));
  for (const auto& color : red.colors) EXPECT_EQ(color, (std::array<std::uint8_t, 4>{255, 0, 0, 102}));
  const Mesh mixed =
      readAgain(scene("a: { shape: mesh, vertices: [0 0 0 1 0 0 0 1 0], triangles: [0 1 2], vertex_colors: [255 0 0 "
                      "255 0 255 0 255 0 0 255 255] }"));
  EXPECT_EQ(mixed.colors[1], (std::array<std::uint8_t, 4>{0, 255, 0, 255}));
}

TEST(WriteGltf, ShapesOfOneMeshShareItsNumbers) {
  const std::string one = gltfBytes(scene("a: { shape: sphere, size: [1] }"));
  const std::string two = gltfBytes(scene("a: { shape: sphere, size: [1] }\nb: { mimic_shape: a, pose: [1 0 0] }"));
  EXPECT_LT(two.size(), one.size() + 200);
}

TEST(WriteGltf, NamesAreEscapedAndAnEmptySceneIsAFile) {
  Config config;
  config.addFrame("a\"b\\\n");
  EXPECT_NE(gltfBytes(config).find("\"a\\\"b\\\\\\n\""), std::string::npos);
  EXPECT_EQ(gltfBytes(Config()).substr(0, 4), "glTF");
}

TEST(WriteGltf, AFolderThatIsNotThereIsAnError) {
  EXPECT_THROW(writeGltf(Config(), "/no/such/folder/a.glb"), FileError);
}
