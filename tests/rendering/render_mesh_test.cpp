#include "kinegraph/rendering/render_mesh.h"

#include <gtest/gtest.h>

#include "kinegraph/geometry/shapes/tessellation.h"
#include "tests/support/near.h"

using namespace kinegraph;

namespace {

Geometry meshOf(Mesh mesh, ShapeType type = ShapeType::mesh) {
  Geometry geometry;
  geometry.type = type;
  geometry.mesh = std::make_shared<Mesh>(std::move(mesh));
  return geometry;
}

Mesh boxMesh() { return tessellate({ShapeType::box, {1., 2., 3.}, nullptr}); }

Vector3d normalAt(const RenderMesh& mesh, std::size_t corner) {
  return Eigen::Map<const Eigen::Vector3f>(mesh.normals.data() + 3 * mesh.face_normals[corner]).cast<double>();
}

Vector3d vertexAt(const RenderMesh& mesh, std::size_t corner) {
  return Eigen::Map<const Eigen::Vector3f>(mesh.vertices.data() + 3 * mesh.faces[corner]).cast<double>();
}

}  // namespace

TEST(RenderMesh, ABoxIsShadedFlat) {
  const std::vector<RenderMesh> parts = renderMeshes(meshOf(boxMesh()));
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].faces.size(), 3u * 12u);
  EXPECT_FALSE(parts[0].color);
  for (std::size_t i = 0; i < parts[0].faces.size(); i += 3) {
    const Vector3d a = vertexAt(parts[0], i);
    const Vector3d face = (vertexAt(parts[0], i + 1) - a).cross(vertexAt(parts[0], i + 2) - a).normalized();
    for (std::size_t k = i; k < i + 3; ++k) EXPECT_TRUE(near(normalAt(parts[0], k), face, 1e-6));
  }
}

TEST(RenderMesh, ASphereIsShadedRound) {
  const std::vector<RenderMesh> parts = renderMeshes({ShapeType::sphere, {.5}, nullptr});
  ASSERT_EQ(parts.size(), 1u);
  for (std::size_t i = 0; i < parts[0].faces.size(); ++i) {
    EXPECT_GT(normalAt(parts[0], i).dot(vertexAt(parts[0], i).normalized()), .995);
  }
}

TEST(RenderMesh, AnOpenSurfaceHasTwoSides) {
  const std::vector<RenderMesh> parts = renderMeshes({ShapeType::quad, {1., 1.}, nullptr});
  ASSERT_EQ(parts.size(), 1u);
  int up = 0, down = 0;
  for (std::size_t i = 0; i < parts[0].faces.size(); ++i) (normalAt(parts[0], i).z() > 0. ? up : down) += 1;
  EXPECT_EQ(up, 6);
  EXPECT_EQ(down, 6);
}

TEST(RenderMesh, DoubledVerticesDoNotOpenASurface) {
  const Mesh box = boxMesh();
  Mesh soup;
  for (const auto& t : box.triangles) {
    for (const std::uint32_t v : t) soup.vertices.push_back(box.vertices[v]);
    const auto n = std::uint32_t(soup.vertices.size());
    soup.triangles.push_back({n - 3, n - 2, n - 1});
  }
  EXPECT_EQ(renderMeshes(meshOf(soup))[0].faces.size(), 3u * 12u);
}

TEST(RenderMesh, ColorsOfVerticesCutTheMeshIntoParts) {
  Mesh mesh = boxMesh();
  for (const Vector3d& p : mesh.vertices)
    mesh.colors.push_back(p.z() > 0. ? std::array<std::uint8_t, 4>{255, 0, 0, 255}
                                     : std::array<std::uint8_t, 4>{0, 0, 255, 255});
  const std::vector<RenderMesh> parts = renderMeshes(meshOf(mesh));
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].faces.size() + parts[1].faces.size(), 3u * 12u);
  EXPECT_TRUE(near(*parts[0].color, Vector4d(0., 0., 1., 1.), 1e-12));
  EXPECT_TRUE(near(*parts[1].color, Vector4d(1., 0., 0., 1.), 1e-12));
}

TEST(RenderMesh, ManyColorsAreMergedIntoFew) {
  Mesh points;
  for (int i = 0; i < 256; ++i) {
    points.vertices.emplace_back(i, 0., 0.);
    points.colors.push_back({std::uint8_t(i), 100, 100, 255});
  }
  const std::vector<RenderMesh> parts = renderMeshes(meshOf(points, ShapeType::pointCloud));
  EXPECT_LE(parts.size(), 64u);
  EXPECT_GE(parts.size(), 32u);
  std::size_t triangles = 0;
  for (const RenderMesh& part : parts) triangles += part.faces.size() / 3;
  EXPECT_EQ(triangles, 8u * 256u);
}

TEST(RenderMesh, PointsAndLinesAreClosedSolidsAroundThem) {
  Mesh mesh;
  mesh.vertices = {{0., 0., 0.}, {0., 0., 1.}};
  const std::vector<RenderMesh> line = renderMeshes(meshOf(mesh, ShapeType::lines));
  ASSERT_EQ(line.size(), 1u);
  EXPECT_EQ(line[0].faces.size(), 3u * 8u);
  EXPECT_EQ(renderMeshes(meshOf(mesh, ShapeType::pointCloud))[0].faces.size(), 2u * 3u * 8u);
  for (std::size_t i = 0; i < line[0].faces.size(); ++i) EXPECT_NEAR(vertexAt(line[0], i).head<2>().norm(), .002, 1e-6);
}

TEST(RenderMesh, NothingToSeeGivesNothing) {
  EXPECT_TRUE(renderMeshes(meshOf({})).empty());
  EXPECT_TRUE(renderMeshes({ShapeType::marker, {.1}, nullptr}).empty());
  Mesh flat;
  flat.vertices = {{0., 0., 0.}, {1., 0., 0.}, {2., 0., 0.}};
  flat.triangles = {{0, 1, 2}};
  EXPECT_TRUE(renderMeshes(meshOf(flat)).empty());
}
