#include "kinegraph/geometry/distance/cell_distance.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"
#include "kinegraph/geometry/distance/cell_field.h"
#include "kinegraph/geometry/distance/grid_field.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/geometry/shapes/cells.h"

namespace kinegraph {
namespace {

constexpr double kCell = .02;  // m

/// Some blocks of solid cells and single ones.
Geometry drawCells(Rng& rng) {
  Grid grid;
  grid.cells = {30, 21, 17};
  grid.values.assign(30 * 21 * 17, CellKind::free);
  const auto fill = [&](int i, int j, int k) {
    if (i < 30 && j < 21 && k < 17)
      grid.values[std::size_t((i * 21 + j) * 17 + k)] =
          rng.uniform(0., 1.) < .5 ? CellKind::occupied : CellKind::unseen;
  };
  const auto draw = [&](int below) { return int(rng.uniform(0., below)); };
  for (int n = 0; n < 20; ++n) fill(draw(30), draw(21), draw(17));
  for (int n = 0; n < 2; ++n) {
    const int x = draw(26), y = draw(17), z = draw(13);
    for (int i = 0; i < 64; ++i) fill(x + i % 4, y + i / 4 % 4, z + i / 16);
  }
  Geometry geometry;
  geometry.type = kCells;
  geometry.size = {30 * kCell, 21 * kCell, 17 * kCell};
  geometry.grid = std::make_shared<Grid>(std::move(grid));
  return geometry;
}

RigidTransform drawPose(Rng& rng, double spread) {
  const Quaterniond q = Quaterniond(rng.normal(), rng.normal(), rng.normal(), rng.normal()).normalized();
  return {q.toRotationMatrix(), spread * Vector3d(rng.normal(), rng.normal(), rng.normal())};
}

std::vector<Geometry> convexShapes() {
  return {{ShapeType::sphere, {.03}, nullptr},
          {ShapeType::capsule, {.2, .04}, nullptr},
          {ShapeType::ssBox, {.1, .05, .2, .01}, nullptr},
          {ShapeType::cylinder, {.1, .03}, nullptr}};
}

TEST(CellDistance, IsThatOfTheNearestCubeForAllConvexBodies) {
  Rng rng(3);
  const auto cube = makeCollisionBody({ShapeType::box, {kCell, kCell, kCell}, nullptr});
  int apart = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const auto cells = makeCollisionBody(drawCells(rng));
    const CellField& field = *cells->grid().cells;
    const RigidTransform X_WC = drawPose(rng, .1);
    for (const Geometry& shape : convexShapes()) {
      const auto body = makeCollisionBody(shape);
      const RigidTransform X_WB = drawPose(rng, .3);
      double expected = std::numeric_limits<double>::infinity();
      for (int i = 0; i < 30 * 21 * 17; ++i) {
        const std::array<int, 3> at = {i / 17 / 21, i / 17 % 21, i % 17};
        if (!field.solid(at)) continue;
        const Vector3d middle = kCell * Vector3d(at[0] + .5, at[1] + .5, at[2] + .5) - field.half;
        expected = std::min(expected, proximity(*body, X_WB, *cube, {X_WC.R, X_WC * middle}).distance);
      }
      const Proximity near = proximity(*body, X_WB, *cells, X_WC);
      if (expected > -body->radius()) {  // the core is outside
        ++apart;
        EXPECT_NEAR(near.distance, expected, 1e-9);
        EXPECT_NEAR((near.point_a - near.point_b).dot(near.normal), near.distance, 1e-9);
        EXPECT_NEAR(proximity(*cells, X_WC, *body, X_WB).distance, expected, 1e-9);
      } else {
        EXPECT_LE(near.distance, -body->radius());
      }
      for (const double most : {0., .01, .05, .3}) {
        const double given = distanceToCells(*body, X_WB, *cells, X_WC, most);
        if (expected < most && expected > -body->radius()) {
          EXPECT_NEAR(given, expected, 1e-9);
        }
        if (expected >= most) {
          EXPECT_GE(given, most);
        }
        if (expected < most) {
          EXPECT_LT(given, most);
        }
      }
    }
  }
  EXPECT_GT(apart, 20);
}

TEST(CellDistance, TheFieldIsALowerBoundWithinTheDiagonalOfACell) {
  Rng rng(8);
  const auto cells = makeCollisionBody(drawCells(rng));
  const CellField& field = *cells->grid().cells;
  for (int i = 0; i < 500; ++i) {
    const Vector3d point = .35 * Vector3d(rng.normal(), rng.normal(), rng.normal());
    const double least = field.leastDistance(point),
                 exact = proximity(*pointBody(), {Matrix3d::Identity(), point}, *cells, {}).distance;
    EXPECT_LE(least, std::max(exact, 0.) + 1e-12);
    const bool inside = (point.cwiseAbs() - field.half).maxCoeff() < 0.;
    if (inside && least < (CellField::kReach - 1) * kCell) {
      EXPECT_GE(least + std::sqrt(3.) * kCell, exact);
    }
  }
}

TEST(CellDistance, WithoutSolidCellsEverythingIsFar) {
  Geometry geometry;
  geometry.type = kCells;
  geometry.size = {1., 1., 1.};
  geometry.grid = std::make_shared<Grid>(Grid{{10, 10, 10}, std::vector<float>(1000, CellKind::free)});
  const auto cells = makeCollisionBody(geometry);
  EXPECT_EQ(proximity(*pointBody(), {}, *cells, {}).distance, 1e4);
  EXPECT_EQ(distanceToCells(*pointBody(), {}, *cells, {}, .2), .2);
}

TEST(CellDistance, ABodyDeepInABlockIsPushedOutTheShortestWay) {
  Grid grid{{20, 20, 20}, std::vector<float>(8000, CellKind::free)};
  for (int i = 0; i < 8000; ++i) {
    if (i % 20 < 10) grid.values[std::size_t(i)] = CellKind::occupied;  // z < 0
  }
  Geometry geometry;
  geometry.type = kCells;
  geometry.size = {1., 1., 1.};
  geometry.grid = std::make_shared<Grid>(grid);
  const auto cells = makeCollisionBody(geometry), ball = makeCollisionBody({ShapeType::sphere, {.1}, nullptr});
  const Proximity near = proximity(*ball, {Matrix3d::Identity(), Vector3d(.01, .02, -.16)}, *cells, {});
  EXPECT_NEAR(near.distance, -.26, 1e-9);
  EXPECT_NEAR(near.normal.z(), 1., 1e-9);
}

TEST(Cells, InvalidGridsAreRefusedAndTheSurfaceHasTheSixSidesOfASingleCell) {
  Grid grid{{3, 3, 3}, std::vector<float>(27, CellKind::free)};
  EXPECT_THROW(checkCells(grid, {.3, .3, .6}), ValueError);
  EXPECT_THROW(checkCells({{3, 3, 2}, grid.values}, {.3, .3, .2}), ValueError);
  grid.values[13] = .5f;
  EXPECT_THROW(checkCells(grid, {.3, .3, .3}), ValueError);
  grid.values[13] = CellKind::unseen;
  checkCells(grid, {.3, .3, .3});
  const Mesh mesh = cellsSurface(grid, {.3, .3, .3});
  ASSERT_EQ(mesh.triangles.size(), 12u);
  double volume = 0.;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6.;
  EXPECT_NEAR(volume, .001, 1e-9);  // outward
}

}  // namespace
}  // namespace kinegraph
