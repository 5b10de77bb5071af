#include "kinegraph/geometry/files/h5_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"
#include "kinegraph/geometry/files/mesh_file.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

// Written by h5py 3.16 for this test: a tetrahedron, two points, signed integers and a compressed table.
const std::string kFile = KINEGRAPH_SOURCE_DIR "/tests/data/tetrahedron.h5";

}  // namespace

TEST(H5File, ReadsTablesOfAllNumberTypes) {
  const H5File file(kFile);
  const H5Dataset vertices = file.dataset("mesh/vertices");
  EXPECT_EQ(vertices.dims, (std::vector<std::uint64_t>{4, 3}));
  EXPECT_EQ(vertices.numbers, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}));
  EXPECT_EQ(file.dataset("points/vertices").numbers, (std::vector<double>{0, 0, .5, 1, -2, .25}));
  EXPECT_EQ(file.dataset("signed").numbers, (std::vector<double>{-1, 2, -3}));
  EXPECT_TRUE(file.contains("mesh/faces"));
  EXPECT_FALSE(file.contains("mesh/normals"));
  EXPECT_EQ(file.entries("mesh"), (std::vector<std::string>{"mesh/colors", "mesh/faces", "mesh/vertices"}));
}

TEST(H5File, SaysWhatItCannotRead) {
  const H5File file(kFile);
  const auto message = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const FileError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(message([&] { file.dataset("packed"); }).find("compressed"), std::string::npos);
  EXPECT_NE(message([&] { file.dataset("mesh/normals"); }).find("available: mesh/colors, mesh/faces"),
            std::string::npos);
  EXPECT_NE(message([&] { file.dataset("mesh"); }).find("not a dataset"), std::string::npos);
  EXPECT_NE(message([&] { H5File(KINEGRAPH_SOURCE_DIR "/tests/data/scenes/joints.g"); }).find("not an HDF5 file"),
            std::string::npos);
}

TEST(H5MeshFile, ReadsMeshesFromHdf5) {
  const Mesh mesh = readMeshFile(kFile);
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.triangles[3], (std::array<std::uint32_t, 3>{1, 2, 3}));
  EXPECT_EQ(mesh.colors[3], (std::array<std::uint8_t, 4>{9, 8, 7, 255}));
  const Mesh points = readH5Mesh(kFile, "points");
  EXPECT_EQ(points.vertices[1], Vector3d(1, -2, .25));
  EXPECT_TRUE(points.triangles.empty());
}

TEST(H5File, DamagedFilesAreRefusedOrReadButNeverWorse) {
  std::ifstream stream(kFile, std::ios::binary);
  std::stringstream bytes;
  bytes << stream.rdbuf();
  const std::string good = bytes.str();
  const TemporaryFolder folder;
  Rng rng(5);
  int refused = 0;
  for (int i = 0; i < 200; ++i) {
    std::string bad = good;
    for (int k = 0; k < 4; ++k) bad[std::size_t(rng.uniform(0, double(bad.size())))] = char(rng.bits());
    if (i % 4 == 0) bad.resize(std::size_t(rng.uniform(0, double(bad.size()))));
    const std::string path = folder.write("damaged.h5", bad);
    try {
      readMeshFile(path);
    } catch (const FileError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 50);
}
