#include "kinegraph/geometry/shapes/textured_surface.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kinegraph/geometry/files/image_file.h"
#include "kinegraph/geometry/files/mesh_file.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

const auto kImage = std::make_shared<Image>(encodePng({1, 1, {255, 0, 0}}));

Geometry shape(ShapeType type, std::vector<double> size) {
  Geometry geometry;
  geometry.type = type;
  geometry.size = std::move(size);
  return geometry;
}

/// Returns the texture coordinates of the surface point nearest to p.
std::array<float, 2> at(const Mesh& mesh, const Vector3d& p) {
  const auto nearer = [&](const Vector3d& a, const Vector3d& b) { return (a - p).norm() < (b - p).norm(); };
  return mesh.texcoords[std::size_t(std::min_element(mesh.vertices.begin(), mesh.vertices.end(), nearer) -
                                    mesh.vertices.begin())];
}

}  // namespace

TEST(TexturedSurface, CoversAllTrianglesWithinThePicture) {
  for (const Geometry& geometry :
       {shape(ShapeType::box, {1, 2, 3}), shape(ShapeType::quad, {1, 2}), shape(ShapeType::ssBox, {1, 2, 3, .1}),
        shape(ShapeType::ssBoxElip, {.1, .1, .1, .2, .2, .2, 0.})}) {
    const Mesh mesh = texturedSurface(geometry, kImage);
    ASSERT_EQ(mesh.textures.size(), 1u);
    EXPECT_EQ(mesh.textures[0].count, mesh.triangles.size());
    ASSERT_EQ(mesh.texcoords.size(), mesh.vertices.size());
    for (const auto& uv : mesh.texcoords) {
      for (const float x : uv) EXPECT_TRUE(x > -1e-6f && x < 1.f + 1e-6f) << x;
    }
  }
}

TEST(TexturedSurface, GoesOnceAroundACylinder) {
  const Mesh mesh = texturedSurface(shape(ShapeType::cylinder, {2., .5}), kImage);
  EXPECT_NEAR(at(mesh, {.5, 0., 1.})[0], .5, 1e-6);
  EXPECT_NEAR(at(mesh, {0., .5, 1.})[0], .75, 1e-6);
  EXPECT_NEAR(at(mesh, {0., -.5, 1.})[0], .25, 1e-6);
  EXPECT_NEAR(at(mesh, {.5, 0., 1.})[1], 1., 1e-6);
  EXPECT_NEAR(at(mesh, {.5, 0., -1.})[1], 0., 1e-6);
  for (const auto& triangle : mesh.triangles) {  // none runs back over the whole picture at the seam
    float low = 9.f, high = -9.f;
    for (const std::uint32_t v : triangle) {
      low = std::min(low, mesh.texcoords[v][0]);
      high = std::max(high, mesh.texcoords[v][0]);
    }
    EXPECT_LT(high - low, .3f);
  }
}

TEST(TexturedSurface, IsRepeated) {
  const Mesh mesh = texturedSurface(shape(ShapeType::quad, {1., 1.}), kImage, {3., 2.});
  EXPECT_EQ(at(mesh, {.5, .5, 0.}), (std::array{3.f, 2.f}));
}

TEST(TexturedSurface, MeshesKeepTheirOwnCoordinates) {
  TemporaryFolder folder;
  const Mesh read =
      readMeshFile(folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.5\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"));
  EXPECT_EQ(read.texcoords.size(), 3u);
  EXPECT_TRUE(read.textures.empty());
  Geometry geometry = shape(ShapeType::mesh, {});
  geometry.mesh = std::make_shared<Mesh>(read);
  EXPECT_EQ(at(texturedSurface(geometry, kImage), {0., 0., 0.}), (std::array{.25f, .5f}));
}

TEST(TexturedSurface, AMeshFileFindsThePicturesBesideIt) {
  TemporaryFolder folder;
  folder.write("red.png", kImage->bytes);
  folder.write("odd.png", "not a picture");
  folder.write("a.mtl",
               "newmtl a\nmap_Kd somewhere\\else\\red.png\nnewmtl b\nmap_Kd odd.png\nnewmtl c\nmap_Kd missing.png\n");
  const Mesh mesh =
      readMeshFile(folder.write("a.obj",
                                "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n"
                                "usemtl b\nf 1/1 2/1 3/1\nusemtl c\nf 1/1 2/1 3/1\n"));
  ASSERT_EQ(mesh.textures.size(), 1u);
  EXPECT_EQ(mesh.textures[0].count, 1u);
  EXPECT_EQ(mesh.textures[0].image->bytes, kImage->bytes);
}
