#include "kinegraph/geometry/shapes/tessellation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinegraph/geometry/shapes/shape_types.h"
#include "tests/support/geometry_samples.h"
#include "tests/support/mesh_laws.h"

using namespace kinegraph;
using namespace kinegraph::testing;

namespace {

std::vector<Geometry> shapesWithSurface() {
  return {{ShapeType::box, {.1, .2, .3}, nullptr},
          {ShapeType::sphere, {.2}, nullptr},
          {ShapeType::capsule, {.4, .1}, nullptr},
          {ShapeType::capsule, {0., .1}, nullptr},
          {ShapeType::cylinder, {.4, .1}, nullptr},
          {ShapeType::ssBox, {.4, .3, .2, .05}, nullptr},
          {ShapeType::ssBox, {.4, .2, .2, .1}, nullptr},
          {ShapeType::ssBox, {.4, .3, .2, 0.}, nullptr},
          {ShapeType::ssCylinder, {.4, .2, .05}, nullptr},
          {ShapeType::ssCylinder, {.1, .05, .05}, nullptr},
          {ShapeType::ssBoxElip, {.4, .3, .2, .05, .1, .02, .01}, nullptr},
          sweptHullOf(boxCorners(Vector3d(.1, .2, .3)), .05),
          sweptHullOf(boxCorners(Vector3d(.1, .2, .3)), 0.),
          sweptHullOf({{0, 0, 0}, {.2, 0, 0}, {0, .3, 0}}, .05),
          sweptHullOf({{.1, .2, .3}}, .05)};
}

double meshVolume(ShapeType type, std::vector<double> size) {
  return volume(tessellate({type, std::move(size), nullptr}));
}

Vector3d extent(const Mesh& mesh) {
  Vector3d low = mesh.vertices[0], high = low;
  for (const Vector3d& p : mesh.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return high - low;
}

}  // namespace

TEST(Tessellation, SurfacesAreClosedAndOutward) {
  for (const Geometry& geometry : shapesWithSurface()) {
    const Mesh mesh = tessellate(geometry);
    ASSERT_FALSE(mesh.triangles.empty()) << shapeTypeName(geometry.type);
    EXPECT_EQ(openEdges(mesh), 0) << shapeTypeName(geometry.type);
    EXPECT_GT(volume(mesh), 0.) << shapeTypeName(geometry.type);
  }
}

TEST(Tessellation, EveryTriangleOfAConvexShapeHasAllVerticesBehindIt) {
  for (const Geometry& geometry : shapesWithSurface()) {
    const Mesh mesh = tessellate(geometry);
    double farthest = 0.;
    for (const auto& [i, j, k] : mesh.triangles) {
      const Vector3d a = mesh.vertices[i], across = (mesh.vertices[j] - a).cross(mesh.vertices[k] - a);
      if (across.norm() < 1e-12) continue;
      for (const Vector3d& p : mesh.vertices) farthest = std::max(farthest, across.normalized().dot(p - a));
    }
    EXPECT_LT(farthest, 1e-6) << shapeTypeName(geometry.type);
  }
}

TEST(Tessellation, ABoxHasEightCornersAndTwelveTriangles) {
  const Mesh mesh = tessellate({ShapeType::box, {1, 2, 3}, nullptr});
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_NEAR(volume(mesh), 6., kMergeGrid);
}

TEST(Tessellation, VolumesAreThoseOfTheRoundBodiesWithinTheFacets) {
  using std::numbers::pi;
  const auto expectBelow = [](double given, double exact) {
    EXPECT_LT(given, exact);
    EXPECT_GT(given, (1. - kFacets) * exact);
  };
  expectBelow(meshVolume(ShapeType::sphere, {.2}), 4. / 3. * pi * std::pow(.2, 3));
  expectBelow(meshVolume(ShapeType::capsule, {.4, .1}), 4. / 3. * pi * std::pow(.1, 3) + .4 * pi * .01);
  expectBelow(meshVolume(ShapeType::cylinder, {.4, .1}), .4 * pi * .01);
  // Steiner's formula for the core .3 x .2 x .1 swept by .05
  const double core = .3 * .2 * .1, faces = 2. * (.3 * .2 + .2 * .1 + .3 * .1) * .05,
               edges = pi * .05 * .05 * (.3 + .2 + .1);
  expectBelow(meshVolume(ShapeType::ssBox, {.4, .3, .2, .05}), core + faces + edges + 4. / 3. * pi * std::pow(.05, 3));
}

TEST(Tessellation, SizesAreOuterWidthsIncludingTheRounding) {
  const auto extentOf = [](ShapeType type, std::vector<double> size) {
    return extent(tessellate({type, size, nullptr}));
  };
  EXPECT_LT((extentOf(ShapeType::box, {1, 2, 3}) - Vector3d(1, 2, 3)).norm(), kMergeGrid);
  EXPECT_LT((extentOf(ShapeType::ssBox, {1, 2, 3, .2}) - Vector3d(1, 2, 3)).norm(), kMergeGrid);
  EXPECT_LT((extentOf(ShapeType::sphere, {.5}) - Vector3d(1, 1, 1)).norm(), kMergeGrid);
  EXPECT_LT((extentOf(ShapeType::capsule, {1, .25}) - Vector3d(.5, .5, 1.5)).norm(), kMergeGrid);
  EXPECT_LT((extentOf(ShapeType::cylinder, {1, .25}) - Vector3d(.5, .5, 1)).norm(), kMergeGrid);
  EXPECT_LT((extentOf(ShapeType::ssCylinder, {1, .25, .1}) - Vector3d(.5, .5, 1)).norm(), kMergeGrid);
}

TEST(Tessellation, AHullSweptByABallIsTheRoundedBox) {
  const Mesh swept = tessellate(sweptHullOf(boxCorners(Vector3d(.15, .1, .05)), .05));
  EXPECT_NEAR(volume(swept), meshVolume(ShapeType::ssBox, {.4, .3, .2, .05}), kMergeGrid);
}

TEST(Tessellation, AnEllipsoidSweepWithEqualRadiiIsABallSweep) {
  // Core of half sides w/2 - r, swept by a ball of radius e + r.
  const double elliptic = meshVolume(ShapeType::ssBoxElip, {.4, .3, .2, .05, .05, .05, .02});
  const double rounded = meshVolume(ShapeType::ssBox, {.36 + .14, .26 + .14, .16 + .14, .07});
  EXPECT_NEAR(elliptic, rounded, kMergeGrid);
}

TEST(Tessellation, OddSizesLeaveNoCracks) {
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const auto size = [&] { return std::round(rng.uniform(.01, .5) * 1e9) * 1e-9; };
    const double r = .4 * .01 + .5e-9, x = size(), y = size(), z = size();
    EXPECT_EQ(openEdges(tessellate({ShapeType::box, {x, y, z}, nullptr})), 0) << x << " " << y << " " << z;
    EXPECT_EQ(openEdges(tessellate({ShapeType::ssBox, {x, y, z, r}, nullptr})), 0) << x << " " << y << " " << z;
    EXPECT_EQ(openEdges(tessellate({ShapeType::cylinder, {x, y}, nullptr})), 0) << x << " " << y;
    EXPECT_EQ(openEdges(tessellate({ShapeType::capsule, {x, y}, nullptr})), 0) << x << " " << y;
  }
}

TEST(Tessellation, AQuadIsTwoTrianglesThatLookUp) {
  const Mesh mesh = tessellate({ShapeType::quad, {2, 3}, nullptr});
  ASSERT_EQ(mesh.triangles.size(), 2u);
  double area = 0.;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3d a = mesh.vertices[i], across = (mesh.vertices[j] - a).cross(mesh.vertices[k] - a);
    area += .5 * across.z();
  }
  EXPECT_NEAR(area, 6., kMergeGrid);
}

TEST(Tessellation, AMeshIsItselfAndShapesWithoutSurfaceAreEmpty) {
  Mesh given;
  given.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  given.triangles = {{0, 1, 2}};
  const Mesh same = tessellate({ShapeType::mesh, {}, std::make_shared<Mesh>(given)});
  EXPECT_EQ(same.vertices, given.vertices);
  EXPECT_EQ(same.triangles, given.triangles);
  for (const ShapeType type :
       {ShapeType::none, ShapeType::marker, ShapeType::camera, ShapeType::pointCloud, ShapeType::lines}) {
    EXPECT_TRUE(tessellate({type, {.1}, nullptr}).vertices.empty());
  }
  EXPECT_TRUE(tessellate({ShapeType::mesh, {}, nullptr}).vertices.empty());
}
