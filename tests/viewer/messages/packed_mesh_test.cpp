#include "kinegraph/viewer/messages/packed_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <set>

#include "kinegraph/common/random.h"
#include "kinegraph/viewer/messages/messages.h"

using namespace kinegraph;

namespace {

/// A surface as the page reads it.
struct ReadSurface {
  std::vector<Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<std::uint8_t, 4>> colors;
};

class SurfaceReader {
 public:
  explicit SurfaceReader(const std::string& data) : data_(data) {
    EXPECT_EQ(word(0), std::uint32_t(BinaryKind::surface));
    const std::size_t vertices = word(2), triangles = word(3), colors = word(4);
    differences_ = references_ + 3 * word(6);
    while (read_.triangles.size() < triangles) {
      std::array<int, 3> t;
      for (int& corner : t) corner = vertex(next(), {last_, last_, last_});
      read_.triangles.push_back(t);
      std::vector<std::array<int, 3>> gates{{t[1], t[0], t[2]}, {t[2], t[1], t[0]}, {t[0], t[2], t[1]}};
      while (!gates.empty()) {
        const auto gate = gates.back();
        gates.pop_back();
        const int symbol = next();
        if (symbol == 0) continue;
        const int third = vertex(symbol, gate);
        read_.triangles.push_back({gate[0], gate[1], third});
        gates.push_back({third, gate[1], gate[0]});
        gates.push_back({gate[0], third, gate[1]});
      }
    }
    for (const Vector3d& place : places_) read_.points.push_back(origin() + double(number(10)) * place);
    const std::size_t at = differences_ + 9 * vertices;
    EXPECT_EQ(data.size(), at + 4 * colors);
    for (std::size_t i = 0; i < colors; ++i)
      read_.colors.push_back(
          {byte(at + i), byte(at + colors + i), byte(at + 2 * colors + i), byte(at + 3 * colors + i)});
  }

  ReadSurface result() const { return read_; }

 private:
  std::uint8_t byte(std::size_t at) const { return std::uint8_t(data_.at(at)); }
  std::uint32_t word(std::size_t i) const {
    std::uint32_t value;
    std::memcpy(&value, data_.data() + 4 * i, 4);
    return value;
  }
  float number(std::size_t i) const {
    float value;
    std::memcpy(&value, data_.data() + 4 * i, 4);
    return value;
  }
  Vector3d origin() const { return {number(7), number(8), number(9)}; }
  int next() { return byte(symbol_++); }
  int code(std::size_t start, std::size_t count, std::size_t i) const {
    return byte(start + i) | byte(start + count + i) << 8 | byte(start + 2 * count + i) << 16;
  }
  int vertex(int symbol, const std::array<int, 3>& gate) {
    if (symbol == 2) return last_ = int(places_.size()) - 1 - code(references_, word(6), reference_++);
    Vector3d place = Vector3d::Zero();
    if (gate[0] >= 0) place = places_[gate[0]] + places_[gate[1]] - places_[gate[2]];
    for (std::size_t k = 0; k < 3; ++k) {
      const int z = code(differences_, 3 * word(2), k * word(2) + places_.size());
      place[int(k)] += z % 2 ? -(z + 1) / 2 : z / 2;
    }
    places_.push_back(place);
    return last_ = int(places_.size()) - 1;
  }

  const std::string& data_;
  ReadSurface read_;
  std::vector<Vector3d> places_;
  std::size_t symbol_ = 44, references_ = 44 + word(5), differences_ = 0, reference_ = 0;
  int last_ = -1;
};

ReadSurface readBack(const Mesh& mesh, double cell = 0.) {
  const std::string data = packMesh(7, mesh, cell);
  return SurfaceReader(data).result();
}

/// A grid of points on a function's graph.
Mesh graphOf(int n, const std::function<double(double, double)>& height) {
  Mesh mesh;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j)
      mesh.vertices.emplace_back(double(i) / n, double(j) / n, height(double(i) / n, double(j) / n));
  }
  const auto at = [&](int i, int j) { return std::uint32_t(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// Triangles as sorted lists of corners on a grid that is coarser than the error, from the smallest corner.
std::multiset<std::array<long, 9>> cornersOf(const std::vector<Vector3d>& points,
                                             const std::vector<std::array<int, 3>>& triangles) {
  std::multiset<std::array<long, 9>> all;
  for (const auto& t : triangles) {
    std::array<std::array<long, 3>, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& p = points[std::size_t(t[k])];
      corners[k] = {std::lround(p.x() * 1000.), std::lround(p.y() * 1000.), std::lround(p.z() * 1000.)};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    std::array<long, 9> flat;
    for (std::size_t k = 0; k < 9; ++k) flat[k] = corners[k / 3][k % 3];
    all.insert(flat);
  }
  return all;
}

std::multiset<std::array<long, 9>> cornersOf(const Mesh& mesh) {
  std::vector<std::array<int, 3>> triangles;
  for (const auto& t : mesh.triangles) triangles.push_back({int(t[0]), int(t[1]), int(t[2])});
  return cornersOf(mesh.vertices, triangles);
}

std::multiset<std::array<long, 9>> cornersOf(const ReadSurface& read) { return cornersOf(read.points, read.triangles); }

}  // namespace

TEST(PackedMesh, HasTheTrianglesOfASurfaceWithTheirOrientation) {
  const Mesh mesh = graphOf(20, [](double x, double y) { return .1 * std::round(10. * x * y); });
  EXPECT_EQ(cornersOf(readBack(mesh)), cornersOf(mesh));
}

TEST(PackedMesh, ReadsAnySetOfTriangles) {  // edges of many triangles, several parts, single points
  Rng rng(3);
  const auto integer = [&](int below) { return int(rng.uniform(0., below)); };
  for (int round = 0; round < 50; ++round) {
    Mesh mesh;
    for (int i = 0; i < 12; ++i)
      mesh.vertices.emplace_back(.1 * integer(11), .1 * integer(11), .1 * integer(11) + .001 * i);
    for (int i = 0; i < 30; ++i) {
      const auto corner = [&] { return std::uint32_t(integer(12)); };
      std::array<std::uint32_t, 3> t{corner(), corner(), corner()};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
    }
    EXPECT_EQ(cornersOf(readBack(mesh)), cornersOf(mesh)) << round;
  }
}

TEST(PackedMesh, ErrorsAreBelowAThirtyThousandthOfTheSize) {
  Mesh mesh;
  Rng rng(1);
  for (int i = 0; i < 300; ++i)
    mesh.vertices.emplace_back(rng.uniform(4., 5.), rng.uniform(-2., 1.), rng.uniform(0., .1));
  for (std::uint32_t i = 0; i < 300; i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
  const ReadSurface read = readBack(mesh);
  ASSERT_EQ(read.points.size(), 300u);
  for (const Vector3d& p : mesh.vertices) {
    double nearest = 1.;
    for (const Vector3d& r : read.points) nearest = std::min(nearest, (r - p).cwiseAbs().maxCoeff());
    EXPECT_LT(nearest, 3. / 60000.);
  }
}

TEST(PackedMesh, MergesEqualVerticesButNotOfDifferentColors) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {4, 3, 5}};
  EXPECT_EQ(readBack(mesh).points.size(), 4u);
  EXPECT_TRUE(readBack(mesh).colors.empty());
  mesh.colors.assign(6, {200, 10, 20, 255});
  EXPECT_EQ(readBack(mesh).points.size(), 4u);
  mesh.colors[3] = {1, 2, 3, 255};
  const ReadSurface read = readBack(mesh);
  EXPECT_EQ(read.points.size(), 5u);
  EXPECT_EQ(std::count(read.colors.begin(), read.colors.end(), std::array<std::uint8_t, 4>{1, 2, 3, 255}), 1);
}

TEST(PackedMesh, CoarserCellsLeaveFewerVerticesNearTheSurface) {
  const Mesh mesh = graphOf(100, [](double x, double y) { return .1 * std::sin(6. * x) * std::cos(5. * y); });
  const std::size_t whole = packMesh(0, mesh).size(), coarse = packMesh(0, mesh, .05).size();
  EXPECT_LT(coarse, whole / 10);
  for (const Vector3d& p : readBack(mesh, .05).points)
    EXPECT_NEAR(p.z(), .1 * std::sin(6. * p.x()) * std::cos(5. * p.y()), .02);
}

TEST(PackedMesh, AFlatOrTinyMeshIsRead) {
  for (const double size : {0., 1e-9, 1e-3, 1e5}) {
    Mesh mesh;
    mesh.vertices = {{size, 0, 0}, {0, size, 0}, {0, 0, 0}};
    mesh.triangles = {{0, 1, 2}};
    const ReadSurface read = readBack(mesh);
    EXPECT_EQ(read.triangles.size(), size > 1e-6 ? 1u : read.triangles.size());
    for (const Vector3d& p : read.points) EXPECT_TRUE(p.allFinite());
  }
}
