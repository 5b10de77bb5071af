#include "kinegraph/geometry/files/mesh_file.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>

#include "kinegraph/common/errors.h"
#include "kinegraph/geometry/files/mesh_cache.h"
#include "kinegraph/geometry/shapes/scale_mesh.h"
#include "tests/support/mesh_laws.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;
using namespace kinegraph::testing;

namespace {

constexpr double kFloat = 1e-6;  // mesh files store single precision

/// A file in a folder of its own that goes away with the test.
class MeshFile : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& content) const { return folder_.write(name, content); }

  TemporaryFolder folder_;
};

/// A corner of a cube: four vertices, sides 1 2 3, volume 1.
const char* const kTetrahedron = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

std::string binaryStl(std::uint32_t announced, const std::vector<std::array<float, 9>>& triangles) {
  std::string file(80, ' ');
  file.append(reinterpret_cast<const char*>(&announced), 4);
  for (const auto& corners : triangles) {
    const float normal[3] = {0.f, 0.f, 1.f};
    file.append(reinterpret_cast<const char*>(normal), 12);
    file.append(reinterpret_cast<const char*>(corners.data()), 36);
    file.append(2, '\0');
  }
  return file;
}

std::string messageOfMesh(const std::string& path) {
  try {
    readMeshFile(path);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_F(MeshFile, AnObjFileGivesItsVerticesAndTriangles) {
  const Mesh mesh = readMeshFile(write("corner.obj", kTetrahedron));
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_NEAR(volume(mesh), 1., kFloat);
}

TEST_F(MeshFile, AMeshWithoutMaterialsHasNoColors) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::string missing = "mtllib missing.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
  const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::vector<std::pair<const char*, std::string>> files = {
      {"bare.obj", kTetrahedron},
      {"lost.obj", missing},
      {"bare.ply", ply},
      {"bare.off", off},
      {"bare.stl", binaryStl(1, {{0, 0, 0, 1, 0, 0, 1, 1, 0}})}};
  for (const auto& [name, text] : files) {
    const Mesh mesh = readMeshFile(write(name, text));
    EXPECT_GE(mesh.vertices.size(), 3u) << name;
    EXPECT_TRUE(mesh.colors.empty()) << name;
  }
}

TEST_F(MeshFile, PolygonsAreCutIntoTriangles) {
  const Mesh mesh = readMeshFile(write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"));
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

TEST_F(MeshFile, EqualVerticesOfAnStlFileAreJoined) {
  const Mesh mesh =
      readMeshFile(write("square.stl", binaryStl(2, {{0, 0, 0, 1, 0, 0, 1, 1, 0}, {0, 0, 0, 1, 1, 0, 0, 1, 0}})));
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

TEST_F(MeshFile, VertexColorsOfAPlyFileAreRead) {
  const Mesh mesh =
      readMeshFile(write("colored.ply",
                         "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                         "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                         "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                         "0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n3 0 1 2\n"));
  ASSERT_EQ(mesh.colors.size(), 3u);
  EXPECT_EQ(mesh.colors[0], (std::array<std::uint8_t, 4>{255, 0, 0, 255}));
}

TEST_F(MeshFile, AMissingFileAndAFolderAreRefusedByName) {
  EXPECT_NE(messageOfMesh((folder_ / "nothing.stl").string()).find("nothing.stl"), std::string::npos);
  EXPECT_NE(messageOfMesh(folder_.path().string()), "");
}

TEST_F(MeshFile, EmptyFilesAreRefused) {
  for (const char* name : {"empty.stl", "empty.obj", "empty.ply", "empty.dae", "empty.glb"}) {
    EXPECT_NE(messageOfMesh(write(name, "")).find(name), std::string::npos) << name;
  }
}

TEST_F(MeshFile, FilesOfAnotherContentOrEndingAreRefused) {
  for (const char* name : {"text.stl", "text.obj", "text.ply", "text.dae", "text.glb", "text.unknown", "text"}) {
    EXPECT_NE(messageOfMesh(write(name, "this is a letter, not a mesh\n")).find(name), std::string::npos) << name;
  }
}

TEST_F(MeshFile, FilesThatBreakOffAreRefused) {
  EXPECT_NE(messageOfMesh(write("short.stl", binaryStl(1000, {{0, 0, 0, 1, 0, 0, 1, 1, 0}}))), "");
  EXPECT_NE(messageOfMesh(write("short.glb", std::string("glTF\2\0\0\0\xff\0\0\0", 12))), "");
}

TEST_F(MeshFile, BytesBehindAnStlFileAndCapitalsDoNotMatter) {
  const std::string file = binaryStl(1, {{0, 0, 0, 1, 0, 0, 1, 1, 0}});
  EXPECT_EQ(readMeshFile(write("long.stl", file + std::string(4, '\0'))).triangles.size(), 1u);
  EXPECT_EQ(readMeshFile(write("CAPITALS.STL",
                               "SOLID X\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\n"
                               "VERTEX 0 1E0 0\nENDLOOP\nENDFACET\nENDSOLID X\n"))
                .triangles.size(),
            1u);
}

TEST_F(MeshFile, AnObjFileMayOmitZerosBeforeThePoint) {
  const Mesh mesh = readMeshFile(write("half.obj", "v 0 0 0\nv .5 0 0\nv 0 -.5 0\nv 0\t0 +.5\nf 1 2 3\nf 1 3 4\n"));
  ASSERT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.vertices[1], Vector3d(.5, 0, 0));
  EXPECT_EQ(mesh.vertices[2], Vector3d(0, -.5, 0));
  EXPECT_EQ(mesh.vertices[3], Vector3d(0, 0, .5));
}

TEST_F(MeshFile, AFileIsReadOnceUntilItChanges) {
  const std::string path = write("t.obj", kTetrahedron);
  const std::shared_ptr<const Mesh> first = sharedMeshFile(path);
  EXPECT_EQ(sharedMeshFile(path), first);
  write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 3 2\n");
  EXPECT_EQ(sharedMeshFile(path)->vertices.size(), 3u);
}

TEST_F(MeshFile, AChangedMaterialFileIsReadAgain) {
  write("t.mtl", "newmtl a\nKd 1 0 0\n");
  const std::string path = write("t.obj", "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 2 0\nusemtl a\nf 1 3 2\n");
  EXPECT_EQ(sharedMeshFile(path)->colors.at(0)[0], 255);
  write("t.mtl", "newmtl a\nKd 0 1 0 \n");
  EXPECT_EQ(sharedMeshFile(path)->colors.at(0)[0], 0);
}

TEST_F(MeshFile, AScaledMeshIsSharedPerScale) {
  const std::string path = write("scaled.obj", kTetrahedron);
  const Vector3d scale(2., 1., -1.);
  const std::shared_ptr<const Mesh> scaled = sharedMeshFile(path, scale), whole = sharedMeshFile(path);
  EXPECT_EQ(sharedMeshFile(path, scale), scaled);
  EXPECT_EQ(sharedMeshFile(path), whole);
  EXPECT_NE(scaled, whole);
  Mesh expected = *whole;
  scaleMesh(expected, scale);
  EXPECT_EQ(scaled->vertices, expected.vertices);
  EXPECT_EQ(scaled->triangles, expected.triangles);
  write("scaled.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(sharedMeshFile(path, scale)->vertices.size(), 3u);
}

TEST_F(MeshFile, FilesWithoutVerticesAreRefused) {
  EXPECT_NE(messageOfMesh(write("nothing.obj", "# a comment\n")), "");
  EXPECT_NE(messageOfMesh(write("nothing.stl", binaryStl(0, {}))), "");
}

TEST_F(MeshFile, FacesThatNameMissingVerticesAreRefused) {
  EXPECT_NE(messageOfMesh(write("beyond.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")), "");
}

TEST_F(MeshFile, VerticesThatAreNotFiniteAreRefused) {
  EXPECT_NE(messageOfMesh(write("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n")), "");
  EXPECT_NE(messageOfMesh(
                write("nan.stl", binaryStl(1, {{0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0, 0, 1, 1, 0}}))),
            "");
}

namespace {

std::string ply(const std::string& vertices, const std::string& faces, const std::string& body) {
  return "ply\nformat ascii 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_index\nend_header\n" + body;
}

const char* const kCorners = "0 0 0\n1 0 0\n0 1 0\n3 0 1 ";

}  // namespace

TEST_F(MeshFile, AFaceThatNamesAVertexBeyondTheLastIsAnError) {
  EXPECT_EQ(readMeshFile(write("good.ply", ply("3", "1", std::string(kCorners) + "2\n"))).triangles.size(), 1u);
  const std::string message = messageOfMesh(write("bad.ply", ply("3", "1", std::string(kCorners) + "4\n")));
  EXPECT_NE(message.find("face 0 names vertex 4 of 3"), std::string::npos) << message;
}

TEST_F(MeshFile, AHeaderThatPromisesMoreThanTheFileHoldsIsAnErrorAtOnce) {
  const std::string body = std::string(kCorners) + "2\n";
  for (const std::string& text :
       {ply("4000000000", "1", body), ply("3", "4000000000", body), ply("3", "200000", body)}) {
    const std::string message = messageOfMesh(write("a.ply", text));
    EXPECT_NE(message.find("more than its"), std::string::npos) << message;
  }
  const std::string gltf =
      R"({"asset": {"version": "2.0"}, "accessors": [{"componentType": 5126, "count": 100000000, "type": "VEC3"}]})";
  EXPECT_NE(messageOfMesh(write("a.gltf", gltf)).find("more than its"), std::string::npos);
  const std::string dae = R"(<COLLADA><float_array id="a" count="4000000000">1 2 3</float_array></COLLADA>)";
  EXPECT_NE(messageOfMesh(write("a.DAE", dae)).find("more than its"), std::string::npos);
}
